// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// A PROFIBUS master brings a DSDPV1 to data exchange, in SystemVerilog: the chip is the library's model, its user CPU and the master are
// bus functional models. With USE_RTL defined the reference RTL replaces the model, and a scoreboard compares them; with SINGLE_FAULTS as
// well, +fault=N plants the defect N of rtl_ref/dsdpv1/faults.txt. docs/systemverilog.md shows how to run it.
module data_exchange;
  timeunit 1ns;
  timeprecision 1ps;
  import dsdpv1_pkg::*;

  localparam int SLAVE = 5, IDENT = 'h0CC9, BYTES = 4;

  logic reset = 1'b0;
  wire clk, line, l_req, l_sta, d_oe, intr0, pbtxd, pbrts, pbf, br, ready, r_req, r_sta, csr, rd, wr, txd, rts;
  wire [10:0] a;
  wire [7:0] d_chip, d_user;
  wire [1:0] others, others_en;

  dsdpv1_clock u_clock (.clk_o(clk));
`ifdef USE_RTL
  reg [7:0] fault;
  initial if (!$value$plusargs("fault=%d", fault)) fault = 8'd0;
  dsdpv1_scoreboard u_scoreboard (
    .reset_i(reset), .clk_i(clk), .pbrxd_i(line), .pbtxd_o(pbtxd), .pbrts_o(pbrts), .r_req_i(r_req), .r_sta_i(r_sta), .l_req_o(l_req),
    .l_sta_o(l_sta), .a_i(a), .d_i(d_user), .d_o(d_chip), .d_oe_o(d_oe), .csr_i(csr), .rd_i(rd), .wr_i(wr), .intr0_o(intr0), .pbf_o(pbf),
    .br_o(br), .ready_o(ready));
  dsdpv1 u_chip (
`ifdef SINGLE_FAULTS
    .fault_i(fault),
`endif
`else
  dsdpv1_model u_chip (
`endif
    .reset_i(reset), .clk_i(clk), .pbrxd_i(line), .pbtxd_o(pbtxd), .pbrts_o(pbrts), .r_req_i(r_req), .r_sta_i(r_sta), .l_req_o(l_req),
    .l_sta_o(l_sta), .a_i(a), .d_i(d_user), .d_o(d_chip), .d_oe_o(d_oe), .csr_i(csr), .rd_i(rd), .wr_i(wr), .intr0_o(intr0), .pbf_o(pbf),
    .br_o(br), .ready_o(ready));
  dsdpv1_user u_user (
    .r_req_o(r_req), .r_sta_o(r_sta), .l_req_i(l_req), .l_sta_i(l_sta), .a_o(a), .d_o(d_user), .d_i(d_chip), .csr_o(csr), .rd_o(rd),
    .wr_o(wr));
  profibus_segment u_segment (
    .txd_i({txd, pbtxd}), .rts_i({rts, pbrts}), .line_o(line), .others_o(others), .others_en_o(others_en));
  profibus_master #(.ADDRESS(2), .VERBOSE(1)) u_master (.rxd_i(others[1]), .rxd_en_i(others_en[1]), .txd_o(txd), .rts_o(rts));
  dsdpv1_checker #(.BAUD(BAUD_12M)) u_checker (
    .reset_i(reset), .clk_i(clk), .pbrxd_i(line), .pbtxd_o(pbtxd), .pbrts_o(pbrts), .r_req_i(r_req), .r_sta_i(r_sta), .l_req_o(l_req),
    .l_sta_o(l_sta), .a_i(a), .d_i(d_user), .d_o(d_chip), .d_oe_o(d_oe), .csr_i(csr), .rd_i(rd), .wr_i(wr), .intr0_o(intr0), .pbf_o(pbf),
    .br_o(br), .ready_o(ready));

  task expect_equal(input string what, input int seen, input int wanted);
    if (seen != wanted) $fatal(1, "%0s: %0d, expected %0d", what, seen, wanted);
  endtask

  // Acyclic services, in data exchange.
  task try_services;
    bytes_t data;
    int outcome, fc, count;
    u_master.fdl_status(SLAVE, outcome, fc);
    expect_equal("fdl_status", outcome, ANSWERED);
    u_master.slave_diag(SLAVE, outcome, data, count);
    expect_equal("slave_diag", outcome, ANSWERED);
    expect_equal("bytes of the diagnosis", count, 6);
    expect_equal("its ident number", {16'd0, data[4], data[5]}, IDENT);
    u_master.get_cfg(SLAVE, outcome, data, count);
    expect_equal("get_cfg", outcome, ANSWERED);
    expect_equal("its identifier", {24'd0, data[0]}, 'h33);
    u_master.read_inputs(SLAVE, outcome, data, count);
    expect_equal("bytes of read_inputs", count, BYTES);
    u_master.read_outputs(SLAVE, outcome, data, count);
    expect_equal("bytes of read_outputs", count, BYTES);
    u_master.global_control(CONTROL_FREEZE, 0, BROADCAST, outcome);
    expect_equal("global_control", outcome, SENT);
    u_master.fdl_status(77, outcome, fc);
    expect_equal("fdl_status of nobody", outcome, NO_ANSWER);
    $display("%0.3f us: services are answered", $realtime / 1000.0);
  endtask

  bytes_t outputs, inputs, cfg, received;
  int reached, done, count, turns;
  initial begin
    outputs = {2016'd0, 32'hDDCCBBAA};
    inputs = {2016'd0, 32'h44332211};
    cfg = {2040'd0, 8'h33};  // 4 bytes of inputs and outputs
    #510 reset = 1'b1;  // between two edges of CLK
    u_user.wait_ready;
    u_user.initialise(SLAVE, IDENT, cfg, 1, done);
    expect_equal("initialised", done, 1);
    $display("%0.3f us: the chip is initialised", $realtime / 1000.0);
    u_user.give_inputs(inputs, BYTES);

    u_master.add_slave(SLAVE, "ident=0x0CC9 input_length=4 output_length=4", 2048'd0, 0, cfg, 1);
    u_master.set_outputs(SLAVE, outputs, BYTES);
    u_master.start();
    u_master.wait_state(SLAVE, SLAVE_DATA_EXCHANGE, 64'd10000000000, reached);
    expect_equal("data exchange reached", reached, 1);
    $display("%0.3f us: data exchange with slave %0d", $realtime / 1000.0, SLAVE);

    count = 0;
    for (turns = 0; turns < 20 && (count == 0 || received[0] != 8'hAA); turns = turns + 1) begin
      #100000 u_user.get_outputs(received, count);
    end
    u_master.get_inputs(SLAVE, inputs, turns);
    expect_equal("bytes of outputs", count, BYTES);
    expect_equal("outputs", int'(received[3:0]), 'hDDCCBBAA);
    expect_equal("inputs at the master", int'(inputs[3:0]), 'h44332211);
    $display("%0.3f us: outputs %h, inputs %h", $realtime / 1000.0, received[3:0], inputs[3:0]);
    try_services;
    u_checker.finish;
    expect_equal("violations", u_checker.violations, 0);
    expect_equal("rules were applied", u_checker.applied > 100 ? 1 : 0, 1);
`ifdef USE_RTL
    $display("the scoreboard has seen %0d changes, all alike", u_scoreboard.matched());
`endif
    $display("passed");
    $finish;
  end
endmodule
