// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Four-state simulation of a top, RTL or netlist, on a golden trace: inputs are played at their ticks and all outputs compared at every tick. The macro
// TOP is the top, RSU says that it has the serial ports. The file +golden= has a line for each tick at which a pin changes: tick, levels of the inputs, levels
// of the outputs; an output that is x there may be anything (P5), any other level must be equal in all four states. For 12 cycles before tick 0
// the clock runs with the first inputs, RESET low among them; before these everything is X.
// A unit of time is half a tick, 1/24 ns: pins change at even units, and the comparison is at odd ones.
`timescale 1ps / 1ps
`ifdef RSU
`define INPUTS 40
`define OUTPUTS 18
`define SERIAL , xss, sck, mosi, rxd, mode, adr, ubr, uiv
`define SERIAL_PORTS , .xss_i(xss), .sck_i(sck), .mosi_i(mosi), .rxd_i(rxd), .mode_i(mode), .adr_i(adr), .ubr_i(ubr), .uiv_i(uiv), \
    .miso_o(miso), .miso_oe_o(miso_oe), .txd_o(txd)
`define SERIAL_SEEN , miso_oe !== 1'b0 ? (miso_oe ? miso_late : 1'bx) : 1'bz, txd
`else
`define INPUTS 26
`define OUTPUTS 16
`define SERIAL
`define SERIAL_PORTS
`define SERIAL_SEEN
`endif

module golden_bench;
  parameter [7:0] FAULT = 0;
  parameter integer MISO_DELAY = 120;  // ticks (SP2)
  localparam integer CYCLE = 500;
  localparam [63:0] BEGIN = 12 * CYCLE;

  reg clk;
  reg reset, r_req, r_sta, csr, rd, wr, pbrxd;
  reg [10:0] a;
  reg [7:0] d;
  wire l_req, l_sta, d_oe, intr0, pbtxd, pbrts, pbf, br, ready;
  wire [7:0] d_o;
`ifdef RSU
  reg xss, sck, mosi, rxd;
  reg [1:0] mode, adr;
  reg [2:0] ubr, uiv;
  wire miso, miso_oe, txd;
  reg miso_late;  // the register is seen MISO_DELAY later, but when it begins to drive
  always @(miso) if (miso_oe === 1'b1) miso_late <= #(2 * MISO_DELAY) miso; else miso_late <= miso;
  always @(posedge miso_oe) miso_late <= miso;
`endif
  `TOP dut (
`ifdef SINGLE_FAULTS
    .fault_i(FAULT),
`endif
    .reset_i(reset), .clk_i(clk), .pbrxd_i(pbrxd), .pbtxd_o(pbtxd), .pbrts_o(pbrts), .r_req_i(r_req), .r_sta_i(r_sta), .l_req_o(l_req),
    .l_sta_o(l_sta), .a_i(a), .d_i(d), .d_o(d_o), .d_oe_o(d_oe), .csr_i(csr), .rd_i(rd), .wr_i(wr), .intr0_o(intr0), .pbf_o(pbf), .br_o(br),
    .ready_o(ready) `SERIAL_PORTS);

  wire [`OUTPUTS-1:0] seen = {
    l_req, l_sta, d_oe !== 1'b0 ? (d_oe ? d_o : 8'hxx) : 8'hzz, intr0, pbtxd, pbrts, pbf, br, ready `SERIAL_SEEN};
  reg [`OUTPUTS-1:0] expected;

  integer compared = 0, unknown = 0;
  reg waiting = 1'b0, playing = 1'b0;
  function same(input [`OUTPUTS-1:0] golden, input [`OUTPUTS-1:0] here);
    integer bit_number;
    begin
      same = 1'b1;
      for (bit_number = 0; bit_number < `OUTPUTS; bit_number = bit_number + 1)
        if (golden[bit_number] !== 1'bx && golden[bit_number] !== here[bit_number]) same = 1'b0;
    end
  endfunction

  // Once for all that happens within a tick
  always @(seen or expected) if (playing && !waiting) begin
    waiting = 1'b1;
    #1 waiting = 1'b0;
    compared = compared + 1;
    if (^{d_oe === 1'b1 ? d_o : 8'h00} === 1'bx) unknown = unknown + 1;
    if (!same(expected, seen)) begin
      $display("differs at tick %0d: golden %b, here %b", ($time - BEGIN) / 2, expected, seen);
      $finish(0);
    end
  end

  always #(CYCLE / 2) clk = ~clk;

  integer file, got;
  reg [63:0] at, last;
  reg [`INPUTS-1:0] now;
  reg [`OUTPUTS-1:0] next;
  reg [8191:0] name;
  initial begin
    got = $value$plusargs("golden=%s", name);
    clk = 1'b1;  // an edge at each whole cycle from 0 on
    file = $fopen(name, "r");
    got = $fscanf(file, "%d %b %b\n", at, now, next);
    if (file == 0 || got != 3) begin
      $display("no golden");
      $finish(0);
    end
    #2 {reset, r_req, r_sta, csr, rd, wr, a, d, pbrxd `SERIAL} = now;
    #(BEGIN - 2) playing = 1'b1;
    while (got == 3) begin
      #(2 * at + BEGIN - $time);
      {reset, r_req, r_sta, csr, rd, wr, a, d, pbrxd `SERIAL} <= now;  // after an edge of the clock at this tick (P9)
      expected <= next;
      last = at;
      got = $fscanf(file, "%d %b %b\n", at, now, next);
    end
    #2 $display("equal: %0d cycles, %0d ticks compared, D unknown in %0d", last / 250, compared, unknown);
    $finish(0);
  end
endmodule
