// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into uart_tx. No answer is ordered while PBRTS is high: that is nothing_decided_while_sending.
reg rts_before = 1'b0, ended = 1'b0;
always @(posedge clk_i) begin
  rts_before <= rst_ni && rts_q;
  ended <= fall_o || abort_i;
end
initial assume (!rst_ni);
always @* begin
  if (rts_q) assume (!send_i);
  assert (state_q <= TRAIL);
  assert (bit_q <= 4'd10);
  assert (rts_q == (state_q == LEAD || state_q == SEND || state_q == TRAIL));
  assert (risen_q == (rts_q && !rts_before));
  if (state_q != SEND) assert (txd_q);
  if (rst_ni && rts_before && !rts_q) assert (ended);
end
