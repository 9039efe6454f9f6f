// Bound into dsdpv1. INTR0 is low for exactly INTR_LOW = 64 cycles a pulse (P7), unless RESET ends it.
reg [6:0] low_for = 7'd0;
always @(posedge clk_i) low_for <= intr0_o || !rst_n ? 7'd0 : low_for + 7'd1;
initial assume (!reset_i);
always @* begin
  assert (low_for <= 7'd64);
  if (rst_n && intr0_o && low_for != 7'd0) assert (low_for == 7'd64);
end
