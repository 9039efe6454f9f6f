// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into uart_tx (8.3, P2). From the first start bit on an answer is all its characters of 11 bits without a gap, each bit as long as the rate of the request says,
// start bits low, stop bits high. PBRTS is high rts_lead_i before, over every bit, and rts_trail_i after. At its end as many were taken as length_i says.
// No answer is ordered while PBRTS is high (nothing_decided_while_sending), and the length of one does not change meanwhile (fdl).
reg [3:0] rate = 4'd0, m_bit = 4'd0;
reg [12:0] m_left = 13'd0;      // cycles left of the bit
reg [7:0] m_characters = 8'd0;  // begun
reg [5:0] m_lead = 6'd0, m_trail = 6'd0;
wire [5:0] lead = $anyconst, trail = $anyconst;
reg m_sends = 1'b0, m_ends = 1'b0, rts_before = 1'b0, aborted = 1'b1;
reg [7:0] length = 8'd0;
wire first = rts_q && !txd_q && !m_sends;  // the first cycle of the first start bit
wire [12:0] bit_last = bit_cycles(rate) - 13'd1;
wire sends = m_sends || first;
wire [12:0] left = first ? bit_last : m_left;
wire [3:0] number = first ? 4'd0 : m_bit;
wire [7:0] characters = first ? 8'd1 : m_characters;
wire bit_over = sends && left == 13'd0;
wire last = bit_over && number == 4'd10 && characters == length_i;
always @(posedge clk_i) begin
  aborted <= !rst_ni || abort_i;
  rts_before <= rst_ni && rts_q;
  length <= length_i;
  if (!rst_ni) rate <= 4'd0;
  else if (send_i && !abort_i) rate <= rate_i;
  m_lead <= rts_q && !m_sends && !first ? m_lead + 6'd1 : 6'd0;
  m_trail <= m_ends && rts_q ? m_trail + 6'd1 : 6'd0;
  if (!rst_ni || abort_i || !rts_q) begin
    m_sends <= 1'b0;
    m_ends <= 1'b0;
  end else if (last) begin
    m_sends <= 1'b0;
    m_ends <= 1'b1;
  end else if (sends) begin
    m_sends <= 1'b1;
    m_left <= bit_over ? bit_last : left - 13'd1;
    m_bit <= !bit_over ? number : number == 4'd10 ? 4'd0 : number + 4'd1;
    m_characters <= bit_over && number == 4'd10 ? characters + 8'd1 : characters;
  end
end
initial assume (!rst_ni);
always @* begin
  assume (rts_lead_i == lead && rts_trail_i == trail && lead <= 6'd32 && trail <= 6'd32);
  if (rts_q) assume (!send_i && length_i == length && length_i != 8'd0);
  if (rst_ni && !aborted) begin
    if (sends && number == 4'd0) assert (!txd_q);
    if (sends && number == 4'd10) assert (txd_q);
    if (first) assert (m_lead == rts_lead_i && !m_ends);
    if (!sends) assert (txd_q);
    if (rts_before && !rts_q) assert (m_ends && m_trail == rts_trail_i);
  end
`ifdef TWIN
  assume (rate_i == 4'd0 && min_tsdr_i == 8'd0 && clock_phase_i == 13'd0 && length_i <= 8'd2 && lead == 6'd0);  // the shortest trace
`else  // what makes this inductive
  if (rst_ni) begin
    assert (state_q <= TRAIL && rate == rate_q && rts_q == (state_q == LEAD || state_q == SEND || state_q == TRAIL));
    assert (rts_before || !m_sends);
    if (state_q == SEND) assert (sends && left == phase_q && number == bit_q && characters == index_q && bit_q <= 4'd10 && !m_ends);
    if (state_q == SEND && bit_q <= 4'd9) assert (shift_q[4'd9 - bit_q]);
    if (state_q == SEND) assert (txd_q || bit_q != 4'd10);
    if (state_q == SEND) assert (!txd_q || bit_q != 4'd0);
    if (state_q != SEND) assert (txd_q && !(m_sends && rts_q));
    if (state_q == WAIT || state_q == LEAD) assert (index_q == 8'd0);
    if (state_q == LEAD) assert (m_lead < lead && !m_ends && {4'd0, m_lead} + count_q + 10'd1 == {4'd0, rts_lead_i});
    if (state_q == TRAIL) assert (m_trail < trail && m_ends && {4'd0, m_trail} + count_q + 10'd1 == {4'd0, rts_trail_i});
  end
`endif
end
