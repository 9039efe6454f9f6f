// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// The 48 MHz of CLK for benches without a clock: each edge is rounded to 1 ps from its absolute time, so nothing drifts. It begins high at
// time 0; its rising edge n is at n / 48 us.
module dsdpv1_clock (
  output reg clk_o
);
  /* verilator no_inline_module */  // its 5.006 scales the delays of an inlined module by the parent's time unit
  timeunit 1ps;
  timeprecision 1ps;
  // A half of the cycle is 62 500 / 6 ps: two of three halves are 10 417 ps long, one is 10 416 ps, in this order.
  initial begin
    clk_o = 1'b1;
    forever begin
      #10417 clk_o = !clk_o;
      #10416 clk_o = !clk_o;
      #10417 clk_o = !clk_o;
    end
  end
endmodule
