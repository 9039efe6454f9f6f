// The reference RTL under Icarus, driven by recorded inputs: the file named by +inputs= has a line for each time at which one of them
// changes, picoseconds and the bits of RESET, R_REQ, R_STA, CSR, RD, WR, A, D, PBRXD; of a DSDPV1-RSU (macro RSU) also of XSS, SCK, MOSI, RXD,
// MODE, ADR, UBR, UIV. The wave, named by +wave=, begins 250 ns (12 cycles)
// after the simulation does: before that the chip is clocked out of reset and in it, as the lockstep does before its time begins.
`timescale 1ps / 1ps
`ifdef RSU
`include "dsdpv1_rsu_types.svh"
`define CHIP dsdpv1_rsu
`define INPUTS 40
`define SERIAL , xss, sck, mosi, rxd, mode, adr, ubr, uiv
`define SERIAL_PORTS , .xss_i(xss), .sck_i(sck), .mosi_i(mosi), .rxd_i(rxd), .mode_i(mode), .adr_i(adr), .ubr_i(ubr), .uiv_i(uiv)
`else
`include "dsdpv1_types.svh"
`define CHIP dsdpv1
`define INPUTS 26
`define SERIAL
`define SERIAL_PORTS
`endif

module bench;
  parameter [7:0] FAULT = 0;
  parameter integer SEARCH_WINDOW_MS = 50, SEARCH_WINDOW_BITS = 4000, BAUD_CONTROL_MS = 600;
  localparam [63:0] BEGIN = 250000;

  // 48 MHz: half a cycle is 125 ticks of 1/12 ns, each edge rounded from its own tick.
  reg clk = 1'b1;
  reg [63:0] half = 0;
  always begin
    #(((half + 1) * 62500 + 3) / 6 - (half * 62500 + 3) / 6);
    half = half + 1;
    clk = ~half[0];
  end

  reg reset = 1'b1, r_req = 1'b0, r_sta = 1'b0, csr = 1'b1, rd = 1'b1, wr = 1'b1, pbrxd = 1'b1;
  reg [10:0] a = 11'h000;
  reg [7:0] d = 8'hzz;
`ifdef RSU
  reg xss = 1'b1, sck = 1'b0, mosi = 1'b0, rxd = 1'b1;
  reg [1:0] mode = 2'b00, adr = 2'b00;
  reg [2:0] ubr = 3'b000, uiv = 3'b000;
`endif
  `CHIP #(.SEARCH_WINDOW_MS(SEARCH_WINDOW_MS), .SEARCH_WINDOW_BITS(SEARCH_WINDOW_BITS), .BAUD_CONTROL_MS(BAUD_CONTROL_MS)) dut (
    .fault_i(FAULT), .reset_i(reset), .clk_i(clk), .pbrxd_i(pbrxd), .r_req_i(r_req), .r_sta_i(r_sta), .a_i(a), .d_i(d), .csr_i(csr), .rd_i(rd),
    .wr_i(wr) `SERIAL_PORTS);

  integer file, got;
  reg [63:0] at;
  reg [`INPUTS-1:0] now;
  reg [8191:0] inputs, wave;
  initial begin
    got = $value$plusargs("inputs=%s", inputs);
    got = $value$plusargs("wave=%s", wave);
    $dumpfile(wave);
    #(BEGIN / 2) reset = 1'b0;
    #(BEGIN / 2) $dumpvars(1, dut);
    file = $fopen(inputs, "r");
    got = $fscanf(file, "%d %b\n", at, now);
    while (got == 2) begin
      #(at + BEGIN - $time);
      {reset, r_req, r_sta, csr, rd, wr, a, d, pbrxd `SERIAL} <= now;  // after an edge of the clock at this time (P9)
      got = $fscanf(file, "%d %b\n", at, now);
    end
    $finish(0);
  end
endmodule
