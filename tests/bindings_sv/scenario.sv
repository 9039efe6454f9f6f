// The masters of examples/masters.yaml run automatically: no task of profibus_master is called. The user CPU answers acyclic requests from
// one object at slot 1, index 2.
module scenario;
  timeunit 1ps;
  timeprecision 1ps;
  import dsdpv1_pkg::*;

  logic reset = 1'b0;
  wire clk, line, l_req, l_sta, d_oe, intr0, pbtxd, pbrts, pbf, br, ready, r_req, r_sta, csr, rd, wr, txd, rts;
  wire [10:0] a;
  wire [7:0] d_chip, d_user;
  wire [1:0] others, others_en;

  dsdpv1_clock u_clock (.clk_o(clk));
  dsdpv1_model u_chip (
    .reset_i(reset), .clk_i(clk), .pbrxd_i(line), .pbtxd_o(pbtxd), .pbrts_o(pbrts), .r_req_i(r_req), .r_sta_i(r_sta), .l_req_o(l_req),
    .l_sta_o(l_sta), .a_i(a), .d_i(d_user), .d_o(d_chip), .d_oe_o(d_oe), .csr_i(csr), .rd_i(rd), .wr_i(wr), .intr0_o(intr0), .pbf_o(pbf),
    .br_o(br), .ready_o(ready));
  dsdpv1_user #(.DPV1(1)) u_user (
    .r_req_o(r_req), .r_sta_o(r_sta), .l_req_i(l_req), .l_sta_i(l_sta), .a_o(a), .d_o(d_user), .d_i(d_chip), .csr_o(csr), .rd_o(rd),
    .wr_o(wr));
  profibus_segment u_segment (
    .txd_i({txd, pbtxd}), .rts_i({rts, pbrts}), .line_o(line), .others_o(others), .others_en_o(others_en));
  profibus_master #(.SCENARIO("examples/masters.yaml"), .VERBOSE(1)) u_masters (
    .rxd_i(others[1]), .rxd_en_i(others_en[1]), .txd_o(txd), .rts_o(rts));

  bytes_t object = {2016'd0, 32'h44332211};
  int object_size = 4, transported = 0;
  task serve(input int channel);
    bytes_t data;
    int service, slot, index, count;
    u_user.get_request(channel, service, slot, index, data, count);
    if (service == DS_READ) u_user.answer(channel, object, count < object_size ? count : object_size);
    else if (service != 0) begin
      object = data;
      object_size = count;
      u_user.answer(channel, data, count);
      if (service == DS_TRANSPORT) transported = 1;
    end
  endtask

  bytes_t outputs, received;
  int done, count;
  initial begin
    received = 2048'd0;
    #510000 reset = 1'b1;
    u_user.wait_ready;
    u_user.initialise(7, 'h0CC9, {2040'd0, 8'h31}, 1, done);
    u_user.give_inputs(2048'd0, 2);
    while (transported == 0 && $time < 64'd30000000000) begin
      u_user.get_outputs(outputs, count);
      if (count != 0) received = outputs;
      serve(0);
      serve(1);
    end
    if (received[1:0] != 16'h3412) $fatal(1, "the outputs of the script: %h", received[1:0]);
    if (transported == 0) $fatal(1, "the script did not come to its end");
    u_user.pause(64'd1500000000);  // the script has stopped the first master
    done = u_masters.exchanges(7);
    u_user.pause(64'd200000000);
    if (done == 0 || u_masters.exchanges(7) != done) $fatal(1, "data exchanges: %0d, then %0d", done, u_masters.exchanges(7));
    $display("passed");
    $finish;
  end
endmodule
