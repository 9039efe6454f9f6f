// Bound into dsdpv1_rsu. A commit writes nothing while the chip is in an access (4.2).
initial assume (!reset_i);
always @* assert (!(host_we && chip_owns));
