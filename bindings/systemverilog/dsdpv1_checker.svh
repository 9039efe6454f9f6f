// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// Implements the checkers of all kinds: handshake, timing of the host port, cells, service (docs/checks.md). They can be bound like
// scoreboards. Each violation is an $error with its clause and advice.
  `include "dsdpv1_time.svh"

  int handle = 0;
  int violations = 0;
  int applied = 0;  // how often rules were applied, after finish

  task report(input int found);
    if (found < 0) $fatal(1, "%m: %0s", `DSDPV1(error)());
    while (violations < found) begin
      violations = violations + 1;
      if (STOP != 0) $fatal(1, "%m: %0s", `DSDPV1(message)(handle));
      else if (QUIET == 0) $error("%m: %0s", `DSDPV1(message)(handle));
    end
  endtask

  task step;
    if (handle != 0) report(`DSDPV1(checker_step)(handle, half, $time - edge_ps, inputs, outputs));
  endtask

  // At the end of the simulation: checks what can only be decided then. Afterwards nothing is checked.
  task finish;
    report(`DSDPV1(checker_finish)(handle));
    applied = `DSDPV1(checker_applied)(handle);
    if (`DSDPV1(close)(handle) < 0) $fatal(1, "%m: %0s", `DSDPV1(error)());
    handle = 0;
  endtask

  task create;
    handle = `DSDPV1(checker_create)(options, BAUD);
    if (handle == 0) $fatal(1, "%m: %0s", `DSDPV1(error)());
  endtask

  always @(clk_i) count_edge();
  always @(handle or inputs or outputs) step();
