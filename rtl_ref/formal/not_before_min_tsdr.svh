// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into uart_tx (8.3, S11). PBRTS rises no earlier than when the answer's clock, which answer_clock is about, has min_TSDR bit times, or max_TSDR where that is less; and never
// before 11, as min_TSDR is 11 at least (dp_parameters). The first start bit follows PBRTS by its lead (sent_whole), by which that clock is ahead.
reg [8:0] m_bits = 9'd0, m_bits_before = 9'd0;
reg [12:0] m_phase = 13'd0;
reg [3:0] rate = 4'd0;
reg [7:0] wish = 8'd11, wish_before = 8'd11;
reg fresh = 1'b0, rts_before = 1'b0;
wire [7:0] limit = max_tsdr(rate);
wire [7:0] wished = fresh ? min_tsdr_i : wish;
wire [7:0] least = wish_before < limit ? wish_before : limit;
always @(posedge clk_i) begin
  rts_before <= rst_ni && rts_q;
  fresh <= rst_ni && send_i && !abort_i;
  wish <= wished;
  wish_before <= wished;
  m_bits_before <= m_bits;
  if (!rst_ni) rate <= 4'd0;
  else if (send_i && !abort_i) rate <= rate_i;
  if (send_i) begin
    m_bits <= {3'd0, clock_bits_i} + (clock_phase_i == 13'd0 ? 9'd1 : 9'd0);
    m_phase <= clock_phase_i == 13'd0 ? bit_cycles(rate_i) - 13'd1 : clock_phase_i - 13'd1;
  end else begin
    m_bits <= m_bits + (m_phase == 13'd0 ? 9'd1 : 9'd0);
    m_phase <= m_phase == 13'd0 ? bit_cycles(rate) - 13'd1 : m_phase - 13'd1;
  end
end
initial assume (!rst_ni);
always @* begin
  if (rts_q) assume (!send_i);
  assume (min_tsdr_i >= 8'd11);
  if (rst_ni && rts_q && !rts_before) assert (m_bits_before >= {1'b0, least} && m_bits_before >= 9'd11);
`ifdef TWIN
  assume (rate_i == 4'd0);  // the shortest trace
`else  // what makes this inductive
  if (rst_ni) begin
    assert (rts_q == (state_q == LEAD || state_q == SEND || state_q == TRAIL) && state_q <= TRAIL && rate == rate_q);
    if (rts_q && !rts_before) assert (wish_before >= 8'd11);
    if (state_q == WAIT) assert (m_bits == bits_q && m_phase == phase_q && fresh == fresh_q && (fresh || wish >= 8'd11));
    if (state_q == WAIT && !fresh) assert (tsdr_q == (wish < limit ? wish : limit));
  end
`endif
end
