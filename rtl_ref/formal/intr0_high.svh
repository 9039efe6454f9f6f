// Bound into dsdpv1. INTR0 is high for at least INTR_GAP = 64 cycles between two pulses (P7).
reg [6:0] high_for = 7'd64;  // stands still at 64, where it also begins behind RESET
always @(posedge clk_i) begin
  if (!rst_n) high_for <= 7'd64;
  else if (!intr0_o) high_for <= 7'd0;
  else if (high_for != 7'd64) high_for <= high_for + 7'd1;
end
reg was_high = 1'b1;
always @(posedge clk_i) was_high <= intr0_o;
initial assume (!reset_i);
always @* if (was_high && !intr0_o) assert (high_for == 7'd64);
