// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into uart_rx. After the release of the line the receiver is IDLE within ten and a half bit times (section 6), at every rate.
//
// Its surroundings: the rate is one of S2 and only changes where it is selected (baud_search_states), and the receiver runs again only
// after a restart (uart_tx_states, dp_slave_states). `released` counts cycles of a running receiver with PBRXD (synchronised) high,
// `left` the remaining cycles of the character in progress. Their sum does not grow, which proves the property.
reg rate_selected = 1'b0, restarted = 1'b0, run_before = 1'b0;
reg [3:0] rate_before = 4'd0;
reg [16:0] released = 17'd0;
wire [16:0] bound = {4'd0, half} + 17'd10 * bit_len;
wire [16:0] left = timer_q + (17'd10 - sample_q) * bit_len;
always @(posedge clk_i) begin
  rate_selected <= restart_rate_i;
  restarted <= restart_rate_i || restart_rts_i;
  run_before <= run_i && rst_ni;
  rate_before <= rate_i;
  if (!rst_ni || !rxd_i || !run_i || restart_rate_i) released <= 17'd0;
  else if (released != bound) released <= released + 17'd1;
end
initial assume (!rst_ni);
always @* begin
  assume (rate_i <= RATE_LAST);
  if (!rate_selected && rst_ni) assume (rate_i == rate_before);
  if (!run_before && !restarted) assume (!run_i);
  if (!rst_ni) assume (!run_i);

  if (rst_ni && released == bound) assert (state_q == IDLE);
`ifdef TWIN
  assume (rate_i == 4'd0);  // the shortest trace
`else  // what makes this inductive
  assert (state_q <= BREAK);
  if (rst_ni) assert (released <= bound);
  assert (tick_q == (timer_q == 13'd0));
  if (state_q == BREAK) assert (released == 17'd0);
  if (state_q == RECEIVING && run_i) begin
    assert (sample_q <= 4'd10);
    assert (start_bit_q == (sample_q == 4'd0));
    assert (stop_bit_q == (sample_q == 4'd10));
    assert (released + left < bound);
  end
`endif
end
