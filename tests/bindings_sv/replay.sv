// Plays the recorded inputs of a golden trace to the library's model and to the reference RTL with its scoreboard. The file named by
// +inputs= has a line for each time at which one of them changes: picoseconds and the bits of RESET, R_REQ, R_STA, CSR, RD, WR, A, whether
// D is driven, D, PBRXD. Changes of the model's outputs go into the file named by +outputs=: picoseconds and the bits of L_REQ, L_STA, D
// driven, D, INTR0, PBTXD, PBRTS, PBF, BR, READY. With SINGLE_FAULTS defined +fault= plants a defect in the RTL. MODEL and SCOREBOARD name those
// of another kind with the same pins.
`ifdef USE_RTL
`include "dsdpv1_types.svh"
`endif

`ifndef MODEL
`define MODEL dsdpv1_model
`define SCOREBOARD dsdpv1_scoreboard
`endif

module replay;
  timeunit 1ps;
  timeprecision 1ps;

  wire clk;
  dsdpv1_clock u_clock (.clk_o(clk));

  logic reset = 1'b0, r_req = 1'b0, r_sta = 1'b0, csr = 1'b1, rd = 1'b1, wr = 1'b1, pbrxd = 1'b1;
  logic [10:0] a = 11'h000;
  logic [7:0] d_user = 8'h00;
  logic driven = 1'b0;
  wire [7:0] d;
  assign d = driven ? d_user : 8'hzz;

  wire l_req, l_sta, d_oe, intr0, pbtxd, pbrts, pbf, br, ready;
  wire [7:0] d_out;
`ifdef UNCLOCKED
  `MODEL #(.CLOCKED(0)) u_model (
`else
  `MODEL u_model (
`endif
    .reset_i(reset), .clk_i(clk), .pbrxd_i(pbrxd), .pbtxd_o(pbtxd), .pbrts_o(pbrts), .r_req_i(r_req), .r_sta_i(r_sta), .l_req_o(l_req),
    .l_sta_o(l_sta), .a_i(a), .d_i(d), .d_o(d_out), .d_oe_o(d_oe), .csr_i(csr), .rd_i(rd), .wr_i(wr), .intr0_o(intr0), .pbf_o(pbf),
    .br_o(br), .ready_o(ready));

`ifdef USE_RTL
  reg [7:0] fault = 8'd0;
  wire rtl_l_req, rtl_l_sta, rtl_d_oe, rtl_intr0, rtl_pbtxd, rtl_pbrts, rtl_pbf, rtl_br, rtl_ready;
  wire [7:0] rtl_d_out;
  dsdpv1 u_rtl (
    .fault_i(fault), .reset_i(reset), .clk_i(clk), .pbrxd_i(pbrxd), .pbtxd_o(rtl_pbtxd), .pbrts_o(rtl_pbrts), .r_req_i(r_req),
    .r_sta_i(r_sta), .l_req_o(rtl_l_req), .l_sta_o(rtl_l_sta), .a_i(a), .d_i(d), .d_o(rtl_d_out), .d_oe_o(rtl_d_oe), .csr_i(csr),
    .rd_i(rd), .wr_i(wr), .intr0_o(rtl_intr0), .pbf_o(rtl_pbf), .br_o(rtl_br), .ready_o(rtl_ready));
  `SCOREBOARD u_scoreboard (
    .reset_i(reset), .clk_i(clk), .pbrxd_i(pbrxd), .pbtxd_o(rtl_pbtxd), .pbrts_o(rtl_pbrts), .r_req_i(r_req),
    .r_sta_i(r_sta), .l_req_o(rtl_l_req), .l_sta_o(rtl_l_sta), .a_i(a), .d_i(d), .d_o(rtl_d_out), .d_oe_o(rtl_d_oe), .csr_i(csr),
    .rd_i(rd), .wr_i(wr), .intr0_o(rtl_intr0), .pbf_o(rtl_pbf), .br_o(rtl_br), .ready_o(rtl_ready));
`endif

  // Inputs change after an edge of CLK at the same time (P9).
  longint at;
  logic [26:0] now, bits;
  int played = 0;
  always @(played) {reset, r_req, r_sta, csr, rd, wr, a, driven, d_user, pbrxd} <= bits;

  int outputs = 0;
  wire [16:0] levels = {l_req, l_sta, d_oe, d_oe ? d_out : 8'h00, intr0, pbtxd, pbrts, pbf, br, ready};
  always @(levels) if (outputs != 0) $fwrite(outputs, "%0d %b\n", $time, levels);

  int inputs, got;
  longint passed;
  string name;
  initial begin
    bits = {6'b000111, 11'h000, 9'h000, 1'b1};
    if (!$value$plusargs("inputs=%s", name)) $fatal(1, "+inputs=FILE is missing");
    inputs = $fopen(name, "r");
    if (inputs == 0) $fatal(1, "the file of +inputs= cannot be read");
    if ($value$plusargs("outputs=%s", name)) outputs = $fopen(name, "w");
`ifdef USE_RTL
    if (!$value$plusargs("fault=%d", fault)) fault = 8'd0;
`endif
    got = $fscanf(inputs, "%d %b\n", at, now);
    while (got == 2) begin
      passed = $time;
      #(at - passed);
      bits = now;
      played = played + 1;
      got = $fscanf(inputs, "%d %b\n", at, now);
    end
    #1000000;
    if (outputs != 0) $fclose(outputs);
`ifdef USE_RTL
    $display("equal: %0d changes", u_scoreboard.matched());
`endif
    $finish;
  end
endmodule
