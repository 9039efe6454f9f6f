// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// Implements the scoreboards of all kinds: at the first different level they report the pin, both levels, cycle and time, the last input
// and the last events of the model, and stop the simulation. Parameters of the chip are those of the RTL.
//
// Levels are compared when everything in a time step has settled, from the fourth cycle with RESET low on. If the model's D is X, any level
// is right (P5). MISO of the RTL is the pin's register: its pin follows SPI_MISO_DELAY later.
  `include "dsdpv1_time.svh"

  int handle = 0;
  bit differs = 1'b0;
  longint next = 0;

  task report;
    differs = 1'b1;
    if (STOP != 0) $fatal(1, "%m: %0s", `DSDPV1(message)(handle));
    else $error("%m: %0s", `DSDPV1(message)(handle));
  endtask

  task step;
    int found;
    if (handle != 0 && !differs) begin
      found = `DSDPV1(scoreboard_step)(handle, half, $time - edge_ps, inputs, outputs, next);
      if (found < 0) $fatal(1, "%m: %0s", `DSDPV1(error)());
      if (found > 0) report();
      plan_between(next);
    end
  endtask

  // Changes of the model's outputs so far that the RTL made as well.
  function int matched();
    matched = `DSDPV1(scoreboard_matched)(handle);
  endfunction

  task create;
    handle = `DSDPV1(scoreboard_create)(options, TOLERANCE_PS);
    if (handle == 0) $fatal(1, "%m: %0s", `DSDPV1(error)());
  endtask

  bit due = 1'b0;
  always @(clk_i) begin
    count_edge();
    if (half >= next) due = !due;
  end
  always @(handle or due or alarm or inputs or outputs) step();
