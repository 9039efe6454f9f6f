// Bound into dsdpv1. L_REQ and L_STA rise together and fall together (H1).
initial assume (!reset_i);
always @* assert (l_req_o == l_sta_o);
