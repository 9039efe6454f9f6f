// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Two-stage synchroniser (P9): what edge m sampled is seen by the logic at edge m+2. It runs during reset, too.
`include "profibus_types.svh"

module synchroniser #(
  parameter logic POWER_ON = 1'b0
) (
  input  logic clk_i,
  input  logic d_i,
  output logic q_o
);
  logic first_q = POWER_ON;
  logic second_q = POWER_ON;

  always_ff @(posedge clk_i) begin
    first_q <= d_i;
    second_q <= first_q;
  end

  assign q_o = second_q;
endmodule
