// Every task of profibus_master, class 1 and class 2, and every task of dsdpv1_user: a chip whose user answers acyclic requests from its
// own object. The chip is the model, or with USE_RTL the reference RTL with the scoreboard. +gsd= names scenarios/dsdpv1.gsd.
`ifdef USE_RTL
`include "dsdpv1_types.svh"
`endif

module services;
  timeunit 1ps;
  timeprecision 1ps;
  import dsdpv1_pkg::*;

  localparam int SLAVE = 7;
  logic reset = 1'b0;
  wire clk, line, l_req, l_sta, d_oe, intr0, pbtxd, pbrts, pbf, br, ready, r_req, r_sta, csr, rd, wr, txd1, rts1, txd2, rts2;
  wire [10:0] a;
  wire [7:0] d_chip, d_user;
  wire [2:0] others, others_en;

  dsdpv1_clock u_clock (.clk_o(clk));
`ifdef USE_RTL
  dsdpv1_scoreboard u_scoreboard (
    .reset_i(reset), .clk_i(clk), .pbrxd_i(line), .pbtxd_o(pbtxd), .pbrts_o(pbrts), .r_req_i(r_req), .r_sta_i(r_sta), .l_req_o(l_req),
    .l_sta_o(l_sta), .a_i(a), .d_i(d_user), .d_o(d_chip), .d_oe_o(d_oe), .csr_i(csr), .rd_i(rd), .wr_i(wr), .intr0_o(intr0), .pbf_o(pbf),
    .br_o(br), .ready_o(ready));
  dsdpv1 u_chip (
`else
  dsdpv1_model u_chip (
`endif
    .reset_i(reset), .clk_i(clk), .pbrxd_i(line), .pbtxd_o(pbtxd), .pbrts_o(pbrts), .r_req_i(r_req), .r_sta_i(r_sta), .l_req_o(l_req),
    .l_sta_o(l_sta), .a_i(a), .d_i(d_user), .d_o(d_chip), .d_oe_o(d_oe), .csr_i(csr), .rd_i(rd), .wr_i(wr), .intr0_o(intr0), .pbf_o(pbf),
    .br_o(br), .ready_o(ready));
  dsdpv1_user #(.DPV1(1)) u_user (
    .r_req_o(r_req), .r_sta_o(r_sta), .l_req_i(l_req), .l_sta_i(l_sta), .a_o(a), .d_o(d_user), .d_i(d_chip), .csr_o(csr), .rd_o(rd),
    .wr_o(wr));
  profibus_segment #(.STATIONS(3)) u_segment (
    .txd_i({txd2, txd1, pbtxd}), .rts_i({rts2, rts1, pbrts}), .line_o(line), .others_o(others), .others_en_o(others_en));
  profibus_master #(.ADDRESS(1), .RING(1), .OPTIONS("highest_address=3 target_rotation_bits=10000")) u_first (
    .rxd_i(others[1]), .rxd_en_i(others_en[1]), .txd_o(txd1), .rts_o(rts1));
  profibus_master #(.MASTER_CLASS(2), .ADDRESS(2), .OPTIONS("highest_address=3 target_rotation_bits=10000")) u_second (
    .rxd_i(others[2]), .rxd_en_i(others_en[2]), .txd_o(txd2), .rts_o(rts2));

  task expect_equal(input string what, input int seen, input int wanted);
    if (seen != wanted) $fatal(1, "%0s: %0d, expected %0d", what, seen, wanted);
  endtask

  task by_hand;
    bytes_t data;
    int outcome, fc, count;
    // Set_Prm: lock, no watchdog, min_TSDR 11, ident number
    data = {1992'd0, 8'h00, 8'hC9, 8'h0C, 8'h0B, 8'h00, 8'h00, 8'h80};
    u_first.set_prm(SLAVE, data, 7, outcome, fc);
    expect_equal("set_prm", outcome, ANSWERED);
    u_first.chk_cfg(SLAVE, {2040'd0, 8'h31}, 1, outcome, fc);
    expect_equal("chk_cfg", outcome, ANSWERED);
    u_first.slave_diag(SLAVE, outcome, data, count);
    expect_equal("the station is ready", {31'd0, data[0][1]}, 0);
    expect_equal("its master", {24'd0, data[3]}, 1);
    data = {2032'd0, 16'h5AA5};
    count = 2;
    u_first.data_exchange(SLAVE, data, count, outcome, fc);
    expect_equal("data_exchange", outcome, ANSWERED);
    expect_equal("bytes of its answer", count, 2);
    expect_equal("not in data exchange", {31'd0, pbf}, 0);
    u_first.set_slave_address(SLAVE, 9, 'h0CC9, 0, outcome, fc);
    expect_equal("set_slave_address", outcome, ANSWERED);
    $display("%0d us services by hand: passed", $time / 1000000);
  endtask

  // The user's program: one object at slot 1, index 2, which class 2 may also transport.
  bytes_t object = {2016'd0, 32'h44332211};
  int object_size = 4;
  task serve(input int channel);
    bytes_t data;
    int service, slot, index, count;
    u_user.get_request(channel, service, slot, index, data, count);
    if (service != 0 && slot != 1) u_user.refuse(channel, ACCESS_INVALID_SLOT, 0);
    else if (service == DS_READ) u_user.answer(channel, object, count < object_size ? count : object_size);
    else if (service != 0) begin
      object = data;
      object_size = count;
      u_user.answer(channel, data, count);
    end
  endtask

  bit serving = 1'b0;
  always begin
    wait (serving);
    serve(0);
    serve(1);
  end

  string gsd;
  task by_itself;
    bytes_t data;
    int outcome, codes, count, reached;
    u_first.add_gsd(gsd, "2 bytes in, 2 bytes out", SLAVE, "flags=8");
    u_first.wait_state(SLAVE, SLAVE_DATA_EXCHANGE, 64'd20000000000, reached);
    expect_equal("data exchange", reached, 1);
    u_first.set_clear(1);
    u_first.set_clear(0);
    u_first.release_slave(SLAVE);
    u_first.wait_state(SLAVE, SLAVE_RELEASED, 64'd5000000000, reached);
    expect_equal("released", reached, 1);
    u_first.activate_slave(SLAVE);
    u_first.wait_state(SLAVE, SLAVE_DATA_EXCHANGE, 64'd5000000000, reached);
    expect_equal("activated", reached, 1);
    $display("%0d us a master by itself: passed", $time / 1000000);
  endtask

  task class_1;
    bytes_t data;
    int outcome, codes, count;
    u_first.acyclic_read(SLAVE, 1, 2, 10, outcome, codes, data, count);
    expect_equal("acyclic_read", outcome, ACYCLIC_POSITIVE);
    expect_equal("bytes that were read", count, 4);
    expect_equal("what was read", int'(data[3:0]), 'h44332211);
    u_first.acyclic_write(SLAVE, 1, 2, {2024'd0, 24'hCCBBAA}, 3, outcome, codes);
    expect_equal("acyclic_write", outcome, ACYCLIC_POSITIVE);
    expect_equal("what was written", int'(object[3:0]), 'h00CCBBAA);
    u_first.acyclic_read(SLAVE, 9, 2, 10, outcome, codes, data, count);
    expect_equal("acyclic_read of no slot", outcome, ACYCLIC_NEGATIVE);
    expect_equal("its codes", codes, 'h80B200);
    $display("%0d us class 1: passed", $time / 1000000);
  endtask

  task class_2;
    bytes_t data;
    int connection, state, outcome, codes, count;
    u_second.initiate(SLAVE, 100, connection, state);
    expect_equal("number of the connection", connection, 0);
    expect_equal("initiate", state, CONNECTION_OPEN);
    u_second.acyclic_read(connection, 1, 2, 240, outcome, codes, data, count);
    expect_equal("acyclic_read of class 2", outcome, ACYCLIC_POSITIVE);
    expect_equal("what it has read", int'(data[3:0]), 'h00CCBBAA);
    u_second.acyclic_write(connection, 1, 2, {2032'd0, 16'h2010}, 2, outcome, codes);
    expect_equal("acyclic_write of class 2", outcome, ACYCLIC_POSITIVE);
    data = {2008'd0, 40'h0504030201};
    count = 5;
    u_second.acyclic_transport(connection, 1, 2, data, count, outcome, codes);
    expect_equal("acyclic_transport", outcome, ACYCLIC_POSITIVE);
    expect_equal("bytes of its answer", count, 5);
    expect_equal("its answer", int'(data[4:1]), 'h05040302);
    u_second.abort(connection, 3);
    expect_equal("abort", u_second.connection_state(connection), CONNECTION_CLOSED);
    u_second.stop;
    $display("%0d us class 2: passed", $time / 1000000);
  endtask

  // The shortest pulse of a master's TXD is one bit of its rate.
  longint edge_ps = 0, shortest_ps = 0, pulse_ps;
  always @(txd1) begin
    pulse_ps = $time - edge_ps;
    edge_ps = $time;
    if (pulse_ps < shortest_ps) shortest_ps = pulse_ps;
  end

  task another_rate;
    int outcome, fc, reached;
    u_first.set_baud(BAUD_500K);
    u_first.fdl_status(SLAVE, outcome, fc);
    expect_equal("fdl_status at a rate that the chip does not have", outcome, NO_ANSWER);
    shortest_ps = 64'd1000000000;
    u_first.fdl_status(SLAVE, outcome, fc);
    expect_equal("a bit at 500 kbit/s", int'(shortest_ps), 2000000);
    u_first.set_baud(BAUD_12M);
    u_first.wait_state(SLAVE, SLAVE_DATA_EXCHANGE, 64'd5000000000, reached);
    expect_equal("data exchange at 12 Mbit/s again", reached, 1);
    $display("%0d us rates: passed", $time / 1000000);
  endtask

  int done;
  initial begin
    if (!$value$plusargs("gsd=%s", gsd)) $fatal(1, "+gsd=FILE is missing");
    #510000 reset = 1'b1;
    u_user.wait_ready;
    u_user.initialise(SLAVE, 'h0CC9, {2040'd0, 8'h31}, 1, done);
    expect_equal("initialised", done, 1);
    u_user.give_inputs(2048'd0, 2);
    u_first.start;
    u_second.start;
    by_hand;
    by_itself;
    serving = 1'b1;
    class_1;
    class_2;
    another_rate;
    u_first.stop;
`ifdef USE_RTL
    $display("the scoreboard has seen %0d changes, all alike", u_scoreboard.matched());
`endif
    $display("passed");
    $finish;
  end
endmodule
