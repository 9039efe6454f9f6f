// Bound into watchdog.
initial assume (!rst_ni);
always @* assert (state_q <= WD_DP_CONTROL);
