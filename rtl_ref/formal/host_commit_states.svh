// Bound into host_commit: states.
initial assume (!rst_ni);
always @* assert (state_q <= CLEAR);
