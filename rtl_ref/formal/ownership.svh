// Bound into dsdpv1. Ownership of the DPRAM (H1, H2): never both sides at once; L_REQ and L_STA are equal (H1).
//
// The user is free but for rule H2. He looks at L_REQ and at L_STA when he likes, once each, in the third cycle of R_REQ at the
// earliest: up to then the chip may start, because of the synchroniser. RESET ends his ownership: R_REQ stays low until L_REQ of the
// start-up access has been up.
wire looks_at_l_req = $anyseq;
wire looks_at_l_sta = $anyseq;
reg [1:0] r_req_before = 2'b00;
reg r_sta_before = 1'b0, l_req_seen_low = 1'b0, l_sta_seen_low = 1'b0, started_up = 1'b0;
wire may_look = r_req_i && r_req_before == 2'b11;
wire l_req_low = l_req_seen_low || (may_look && looks_at_l_req && !l_req_o);
wire l_sta_low = l_sta_seen_low || (may_look && looks_at_l_sta && !l_sta_o);
always @(posedge clk_i) begin
  r_req_before <= {r_req_before[0], r_req_i};
  r_sta_before <= r_sta_i;
  l_req_seen_low <= r_req_i && l_req_low;
  l_sta_seen_low <= r_req_i && l_sta_low;
  started_up <= rst_n && (started_up || l_req_o);
end
initial assume (!reset_i);
always @* begin
  if (!rst_n || !started_up) assume (!r_req_i);
  if (!r_req_i) assume (!r_sta_i);
  if (r_sta_i && !r_sta_before) assume (l_req_low && l_sta_low);
  assert (!(l_sta_o && r_sta_i));
end
