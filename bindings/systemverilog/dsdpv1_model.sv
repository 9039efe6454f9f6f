// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// The DSDPV1 as the library's model, with parameters and ports of the reference RTL (rtl_ref/dsdpv1/dsdpv1.sv): either may stand in the
// place of the other. The library is called at an edge of CLK at which an output may change, and at each change of an input.
//
// Outputs change at their edge of CLK, D at the falling one (section 12). X at an input counts as its level of rest, a D with an X or Z in
// it as released.
//
// With CLOCKED = 0 the model has its own 48 MHz, whose rising edge n is at n / 48 us: clk_i is not looked at, so that a bench need not
// simulate a clock. Each change is then at its absolute time, in ps rounded to the nearest tick of 1/12 ns and back.
`include "dsdpv1_calls.svh"

module dsdpv1_model #(
  parameter integer ACCESS_INTERVAL = 48,       // cycles from one DPRAM access to the next (H1)
  parameter integer READY_CYCLES = 4096,        // from R until B004 is due (D1)
  parameter integer RTS_LEAD = 4,               // P2; 0 to 32
  parameter integer RTS_TRAIL = 4,              // P2; 0 to 32
  parameter integer INTR_LOW = 64,              // P7
  parameter integer INTR_GAP = 64,              // P7
  parameter integer SEARCH_WINDOW_MS = 50,      // S1
  parameter integer SEARCH_WINDOW_BITS = 4000,  // S1
  parameter integer BAUD_CONTROL_MS = 600,      // S1
  parameter integer CLOCKED = 1                 // 0: without CLK
) (
  input  logic        reset_i,
  input  logic        clk_i,
  input  logic        pbrxd_i,
  output logic        pbtxd_o,
  output logic        pbrts_o,
  input  logic        r_req_i,
  input  logic        r_sta_i,
  output logic        l_req_o,
  output logic        l_sta_o,
  input  logic [10:0] a_i,
  input  logic [7:0]  d_i,
  output logic [7:0]  d_o,
  output logic        d_oe_o,
  input  logic        csr_i,
  input  logic        rd_i,
  input  logic        wr_i,
  output logic        intr0_o,
  output logic        pbf_o,
  output logic        br_o,
  output logic        ready_o
);
  /* verilator no_inline_module */  // its 5.006 scales the delays of an inlined module by the parent's time unit
  timeunit 1ps;
  timeprecision 1ps;
  `DSDPV1_IMPORTS
  `include "dsdpv1_pins.svh"

  int handle = 0;
  longint next = 0;  // when an output may change by itself: half cycle, without CLK ps

  // Without CLK: the earliest wake-up on its way. It cannot be taken back; one that has become needless does no harm.
  longint planned = -1;
  int plans = 0;
  task plan(input longint now);
    if (next != 64'sh7FFFFFFFFFFFFFFF && (planned <= now || next < planned)) begin
      planned = next;
      plans = plans + 1;
    end
  endtask

  task step;
    int outputs;
    longint now;
    now = $time;
    if (handle != 0) begin
      outputs = `DSDPV1(model_step)(handle, CLOCKED != 0 ? half : -64'sd1, CLOCKED != 0 ? now - edge_ps : now, {5'd0, inputs}, next);
      if (outputs < 0) $fatal(1, "%m: %0s", `DSDPV1(error)());
      {ready_o, br_o, pbf_o, pbrts_o, pbtxd_o, intr0_o, l_sta_o, l_req_o} <= outputs[7:0];
      d_oe_o <= outputs[16];
      d_o <= outputs[17] ? 8'hxx : outputs[15:8];
      if (CLOCKED == 0) plan(now);
    end
  endtask

  initial begin
    string options;
    options = $sformatf(
      "access_interval=%0d ready_cycles=%0d rts_lead=%0d rts_trail=%0d intr_low=%0d intr_gap=%0d search_window_ms=%0d search_window_bits=%0d baud_control_ms=%0d",
      ACCESS_INTERVAL, READY_CYCLES, RTS_LEAD, RTS_TRAIL, INTR_LOW,
      INTR_GAP, SEARCH_WINDOW_MS, SEARCH_WINDOW_BITS, BAUD_CONTROL_MS);
    handle = `DSDPV1(model_create)(options);
    if (handle == 0) $fatal(1, "%m: %0s", `DSDPV1(error)());
  end

  bit due = 1'b0;
  int alarm = 0;
  generate
    if (CLOCKED != 0) begin : clocked
      always @(clk_i) begin
        count_edge();
        if (half >= next) due = !due;
      end
    end else begin : by_itself
      always @(plans) alarm <= #(planned - $time) plans;
    end
  endgenerate
  always @(handle or due or alarm or inputs) step();
endmodule
