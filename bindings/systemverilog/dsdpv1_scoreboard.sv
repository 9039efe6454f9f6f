// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// The model beside somebody's RTL, on the same pins: at the first different level it says which pin, both levels, cycle and time, the last
// input and the last events of the model, and stops the simulation. Parameters of the chip are those of the RTL, and all ports have the
// names of the reference RTL's, so that it can be bound:
//
//   bind dsdpv1 dsdpv1_scoreboard u_scoreboard (.*);
//
// Levels are compared when all of a time step has settled, from the fourth cycle with RESET low on. Where the model says that D is X, any
// level is right (P5).
`include "dsdpv1_calls.svh"

module dsdpv1_scoreboard #(
  parameter integer ACCESS_INTERVAL = 48,       // cycles from one DPRAM access to the next (H1)
  parameter integer READY_CYCLES = 4096,        // from R until B004 is due (D1)
  parameter integer RTS_LEAD = 4,               // P2; 0 to 32
  parameter integer RTS_TRAIL = 4,              // P2; 0 to 32
  parameter integer INTR_LOW = 64,              // P7
  parameter integer INTR_GAP = 64,              // P7
  parameter integer SEARCH_WINDOW_MS = 50,      // S1
  parameter integer SEARCH_WINDOW_BITS = 4000,  // S1
  parameter integer BAUD_CONTROL_MS = 600,      // S1
  parameter longint TOLERANCE_PS = 0,           // a difference that lasts no longer than this is none: RTL with delays
  parameter integer STOP = 1                    // 1: $fatal at the first difference; 0: $error
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
      found = `DSDPV1(scoreboard_step)(handle, half, $time - edge_ps, {5'd0, inputs}, {6'd0, outputs}, next);
      if (found < 0) $fatal(1, "%m: %0s", `DSDPV1(error)());
      if (found > 0) report();
    end
  endtask

  // Changes of the model's outputs so far that the RTL has made as well.
  function int matched();
    matched = `DSDPV1(scoreboard_matched)(handle);
  endfunction

  initial begin
    string options;
    options = $sformatf(
      "access_interval=%0d ready_cycles=%0d rts_lead=%0d rts_trail=%0d intr_low=%0d intr_gap=%0d search_window_ms=%0d search_window_bits=%0d baud_control_ms=%0d",
      ACCESS_INTERVAL, READY_CYCLES, RTS_LEAD, RTS_TRAIL, INTR_LOW,
      INTR_GAP, SEARCH_WINDOW_MS, SEARCH_WINDOW_BITS, BAUD_CONTROL_MS);
    handle = `DSDPV1(scoreboard_create)(options, TOLERANCE_PS);
    if (handle == 0) $fatal(1, "%m: %0s", `DSDPV1(error)());
  end

  bit due = 1'b0;
  always @(clk_i) begin
    count_edge();
    if (half >= next) due = !due;
  end
  always @(handle or due or inputs or outputs) step();
endmodule
