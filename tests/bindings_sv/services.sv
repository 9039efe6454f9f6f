// Every task of profibus_master, class 1 and class 2, against a model; a second model that searches the rate by itself stands for what is
// on the line too. C1 and C2 are refused or time out where no user program answers: what is tested is that each task ends with its outcome.
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
  dsdpv1_model u_chip (
    .reset_i(reset), .clk_i(clk), .pbrxd_i(line), .pbtxd_o(pbtxd), .pbrts_o(pbrts), .r_req_i(r_req), .r_sta_i(r_sta), .l_req_o(l_req),
    .l_sta_o(l_sta), .a_i(a), .d_i(d_user), .d_o(d_chip), .d_oe_o(d_oe), .csr_i(csr), .rd_i(rd), .wr_i(wr), .intr0_o(intr0), .pbf_o(pbf),
    .br_o(br), .ready_o(ready));
  dsdpv1_user u_user (
    .r_req_o(r_req), .r_sta_o(r_sta), .l_req_i(l_req), .l_sta_i(l_sta), .a_o(a), .d_o(d_user), .d_i(d_chip), .csr_o(csr), .rd_o(rd),
    .wr_o(wr));
  profibus_segment #(.STATIONS(3)) u_segment (
    .txd_i({txd2, txd1, pbtxd}), .rts_i({rts2, rts1, pbrts}), .line_o(line), .others_o(others), .others_en_o(others_en));
  profibus_master #(.ADDRESS(1), .RING(1)) u_first (.rxd_i(others[1]), .rxd_en_i(others_en[1]), .txd_o(txd1), .rts_o(rts1));
  profibus_master #(.MASTER_CLASS(2), .ADDRESS(2), .OPTIONS("highest_address=3")) u_second (
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

  task by_itself;
    bytes_t data;
    int outcome, codes, count, reached;
    u_first.add_slave(SLAVE, "ident=0x0CC9 input_length=2 output_length=2", 2048'd0, 0, {2040'd0, 8'h31}, 1);
    u_first.wait_state(SLAVE, SLAVE_DATA_EXCHANGE, 64'd20000000000, reached);
    expect_equal("data exchange", reached, 1);
    u_first.acyclic_read(SLAVE, 1, 2, 10, outcome, codes, data, count);
    expect_equal("acyclic_read, which no user answers", outcome, ACYCLIC_REFUSED);
    u_first.acyclic_write(SLAVE, 1, 2, 2048'd0, 4, outcome, codes);
    expect_equal("acyclic_write, which no user answers", outcome, ACYCLIC_REFUSED);
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

  task class_2;
    int connection, state;
    u_second.start;
    u_second.initiate(SLAVE, 1, connection, state);
    expect_equal("number of the connection", connection, 0);
    expect_equal("initiate without DPV1", state, CONNECTION_CLOSED);
    $display("%0d us class 2: passed", $time / 1000000);
  endtask

  int done;
  initial begin
    #510000 reset = 1'b1;
    u_user.wait_ready;
    u_user.initialise(SLAVE, 'h0CC9, {2040'd0, 8'h31}, 1, done);
    expect_equal("initialised", done, 1);
    u_user.give_inputs(2048'd0, 2);
    u_first.start;
    by_hand;
    by_itself;
    class_2;
    u_first.stop;
    $display("passed");
    $finish;
  end
endmodule
