// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The board's start: the PLL locks, the chip starts up, and a user who takes the DPRAM reads the version (D1) and writes and reads a cell through
// the tri-state pins. The cells are those of Yosys; the PLL's output, which has no model there, is made here.
`timescale 1ns / 1ps
module board_tb;
  reg clk = 1'b0, locked = 1'b0, reset = 1'b0, r_req = 1'b0, r_sta = 1'b0, csr = 1'b1, rd = 1'b1, wr = 1'b1, drives = 1'b0;
  reg [10:0] a = 11'd0;
  reg [7:0] value = 8'h00;
  wire [7:0] d;
  wire miso, pbtxd, pbrts, l_req, l_sta, intr0, pbf, br, ready, txd;
  integer wrong = 0;
  assign d = drives ? value : 8'hzz;
  always #10.4166 clk = !clk;

  board dut (
    .clk_12m_i(1'b0), .reset_i(reset), .pbrxd_i(1'b1), .pbtxd_o(pbtxd), .pbrts_o(pbrts), .r_req_i(r_req), .r_sta_i(r_sta), .l_req_o(l_req),
    .l_sta_o(l_sta), .a_i(a), .d_io(d), .csr_i(csr), .rd_i(rd), .wr_i(wr), .intr0_o(intr0), .pbf_o(pbf), .br_o(br), .ready_o(ready),
    .mode_i(2'b11), .adr_i(2'b11), .ubr_i(3'b111), .uiv_i(3'b111), .xss_i(1'b1), .sck_i(1'b0), .mosi_i(1'b1), .miso_io(miso), .rxd_i(1'b1),
    .txd_o(txd));
  initial begin
    force dut.clk = clk;
    force dut.locked = locked;
  end

  task expects(input integer index, input [7:0] seen, input [7:0] right);
    if (seen !== right) begin
      wrong = wrong + 1;
      $display("check %0d: %h, expected %h", index, seen, right);
    end
  endtask
  task reads(input [10:0] address, input [7:0] right);
    begin
      a = address;
      csr = 1'b0;
      rd = 1'b0;
      #60 expects(address, d, right);
      rd = 1'b1;
      csr = 1'b1;
      #40 expects(address, d, 8'hzz);
    end
  endtask

  initial begin
    #100 reset = 1'b1;
    #100 expects(4000, {7'd0, l_sta}, 8'h00);  // in reset until the PLL has locked
    expects(4001, {2'd0, pbtxd, pbrts, intr0, pbf, br, ready}, 8'b00101100);
    locked = 1'b1;
    wait (l_sta === 1'b1);
    wait (l_sta === 1'b0);  // the start-up access has ended
    r_req = 1'b1;
    #200 r_sta = 1'b1;
    expects(4002, {6'd0, l_req, l_sta}, 8'h00);
    reads(11'h000, 8'h01);
    reads(11'h001, 8'h0D);
    reads(11'h002, 8'h07);
    reads(11'h003, 8'h01);
    reads(11'h130, 8'h00);
    a = 11'h130;
    value = 8'hA5;
    drives = 1'b1;
    csr = 1'b0;
    #20 wr = 1'b0;
    #20 wr = 1'b1;
    #20 drives = 1'b0;
    csr = 1'b1;
    #200 reads(11'h130, 8'hA5);
    expects(4003, {7'd0, miso}, 8'b0000000z);
    if (wrong == 0) $display("the board starts");
    $finish;
  end
  initial begin
    #200000 $display("no end after 200 us");
    $finish;
  end
endmodule
