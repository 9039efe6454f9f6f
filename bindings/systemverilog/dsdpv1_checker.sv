// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// The rules of the user's side (docs/checks.md: handshake, timing of the host port, cells, service) on any pins, those of the model or of
// somebody's RTL. It can be bound as the scoreboard is. Each violation is an $error with its clause and what to do about it.
`include "dsdpv1_calls.svh"

module dsdpv1_checker #(
  parameter LIMITS = "",         // other limits in ticks of 1/12 ns, or off: "TIMING_TS=240 TIMING_TW=off"
  parameter integer BAUD = -1,   // of the line (0: 12M ... 9: 9.6k): telegrams are heard; -1: rules that need them are left out
  parameter integer STOP = 0,    // 1: $fatal at the first violation
  parameter integer QUIET = 0    // 1: violations are only counted
) (
  input  logic        reset_i,
  input  logic        clk_i,
  input  logic        pbrxd_i,
  input  logic        pbtxd_o,
  input  logic        pbrts_o,
  input  logic        r_req_i,
  input  logic        r_sta_i,
  input  logic        l_req_o,
  input  logic        l_sta_o,
  input  logic [10:0] a_i,
  input  logic [7:0]  d_i,
  input  logic [7:0]  d_o,
  input  logic        d_oe_o,
  input  logic        csr_i,
  input  logic        rd_i,
  input  logic        wr_i,
  input  logic        intr0_o,
  input  logic        pbf_o,
  input  logic        br_o,
  input  logic        ready_o
);
  timeunit 1ps;
  timeprecision 1ps;
  `DSDPV1_IMPORTS
  `include "dsdpv1_pins.svh"
  `include "dsdpv1_outputs.svh"

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
    if (handle != 0) report(`DSDPV1(checker_step)(handle, half, $time - edge_ps, {5'd0, inputs}, {6'd0, outputs}));
  endtask

  // At the end of the simulation: what could only then be seen. Afterwards nothing is checked any more.
  task finish;
    report(`DSDPV1(checker_finish)(handle));
    applied = `DSDPV1(checker_applied)(handle);
    if (`DSDPV1(close)(handle) < 0) $fatal(1, "%m: %0s", `DSDPV1(error)());
    handle = 0;
  endtask

  initial begin
    handle = `DSDPV1(checker_create)(LIMITS, BAUD);
    if (handle == 0) $fatal(1, "%m: %0s", `DSDPV1(error)());
  end

  always @(clk_i) count_edge();
  always @(handle or inputs or outputs) step();
endmodule
