// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// Implements the models of all kinds. Calls the library at an edge of CLK at which an output may change, when MISO changes, and at each
// change of an input.
//
// Outputs change at their edge of CLK, D at the falling one (section 12). X at an input counts as its idle level, a D with an X or Z in it
// as released.
//
// With CLOCKED = 0 the model has an internal 48 MHz, whose rising edge n is at n / 48 us: clk_i is ignored, so a bench need not simulate a
// clock. Each change is then at its absolute time, in ps rounded to the nearest tick of 1/12 ns and back.
  `include "dsdpv1_time.svh"

  int handle = 0;
  longint next = 0;  // next change of an output without a change of an input: half cycle, without CLK ps

  task step;
    longint outputs;
    longint now;
    now = $time;
    if (handle != 0) begin
      outputs = `DSDPV1(model_step)(handle, CLOCKED != 0 ? half : -64'sd1, CLOCKED != 0 ? now - edge_ps : now, inputs, next);
      if (outputs < 0) $fatal(1, "%m: %0s", `DSDPV1(error)());
      drive(outputs);
      if (CLOCKED != 0) plan_between(next);
      else if (next != 64'sh7FFFFFFFFFFFFFFF) plan(next);
    end
  endtask

  task create;
    handle = `DSDPV1(model_create)(options);
    if (handle == 0) $fatal(1, "%m: %0s", `DSDPV1(error)());
  endtask

  bit due = 1'b0;
  generate
    if (CLOCKED != 0) begin : clocked
      always @(clk_i) begin
        count_edge();
        if (half >= next) due = !due;
      end
    end
  endgenerate
  always @(handle or due or alarm or inputs) step();
