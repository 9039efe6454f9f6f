// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into dsdpv1. Ownership of the DPRAM (H1, H2, H6): never both sides at once, also through any reset.
//
// The user is free except for rule H2. While R_REQ is high he reads L_REQ and L_STA once each, at any time from the third cycle of
// his hold on: up to then the chip may start, because of the synchroniser. R_STA rises only after both reads. He drops R_REQ and R_STA
// at any time and in any order, and raises R_REQ again at any time. RESET is free, and he ignores it.
wire looks_at_l_req = $anyseq;
wire looks_at_l_sta = $anyseq;
reg [1:0] held_before = 2'b00;
reg r_sta_before = 1'b0, l_req_seen_low = 1'b0, l_sta_seen_low = 1'b0;
wire may_look = r_req_i && held_before == 2'b11;
wire l_req_low = l_req_seen_low || (may_look && looks_at_l_req && !l_req_o);
wire l_sta_low = l_sta_seen_low || (may_look && looks_at_l_sta && !l_sta_o);
always @(posedge clk_i) begin
  held_before <= {held_before[0], r_req_i || r_sta_i};
  r_sta_before <= r_sta_i;
  l_req_seen_low <= r_req_i && l_req_low;
  l_sta_seen_low <= r_req_i && l_sta_low;
end
initial assume (!reset_i);
always @* begin
  if (r_sta_i && !r_sta_before) assume (r_req_i && l_req_low && l_sta_low);
  assert (!(l_sta_o && r_sta_i));
end
