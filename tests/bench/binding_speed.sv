// The rows dpi and vpi: the model in a simulator without CLK, data exchange with 16 bytes each way, back to back at 12 Mbit/s, +exchanges=N times after
// it has been brought up. Prints how often its pins have changed meanwhile, in and out. Requests are bits with their exact times.
module binding_speed;
  timeunit 1ps;
  timeprecision 1ps;
  import dsdpv1_pkg::*;

  localparam int SLAVE = 5;
  logic reset = 1'b0, line = 1'b1;
  wire l_req, l_sta, d_oe, intr0, pbtxd, pbrts, pbf, br, ready, r_req, r_sta, csr, rd, wr;
  wire [10:0] a;
  wire [7:0] d_chip, d_user;
  dsdpv1_model #(.CLOCKED(0)) u_chip (
    .reset_i(reset), .clk_i(1'b0), .pbrxd_i(line), .pbtxd_o(pbtxd), .pbrts_o(pbrts), .r_req_i(r_req), .r_sta_i(r_sta), .l_req_o(l_req),
    .l_sta_o(l_sta), .a_i(a), .d_i(d_user), .d_o(d_chip), .d_oe_o(d_oe), .csr_i(csr), .rd_i(rd), .wr_i(wr), .intr0_o(intr0), .pbf_o(pbf),
    .br_o(br), .ready_o(ready));
  dsdpv1_user u_user (
    .r_req_o(r_req), .r_sta_o(r_sta), .l_req_i(l_req), .l_sta_i(l_sta), .a_o(a), .d_o(d_user), .d_i(d_chip), .csr_o(csr), .rd_o(rd),
    .wr_o(wr));

  longint changes = 0, answers = 0;
  wire [3:0] levels = {pbrts, pbtxd, l_sta, l_req};
  logic [3:0] last = 4'd0;
  int k;
  always @(levels) begin
    for (k = 0; k < 4; k = k + 1) if (levels[k] != last[k]) changes = changes + 1;
    if (levels[3] && !last[3]) answers = answers + 1;
    last = levels;
  end

  longint bits = 0;  // since the start of simulation, 1 / 12 us each
  task pass(input int count);
    longint now;
    bits = bits + {32'd0, count};
    now = $time;
    #((bits * 250000 + 1) / 3 - now);
  endtask

  // A telegram with `count` bytes from DA on: SD2, or SD1 without data; then `idle` bit times.
  task send(input bytes_t body, input int count, input int idle);
    bytes_t telegram;
    logic [7:0] fcs;
    logic [10:0] character;
    int i, k, same, size;
    fcs = 8'h00;
    for (i = 0; i < count; i = i + 1) fcs = fcs + body[i];
    telegram = count == 3 ? {2040'd0, 8'h10} : {2016'd0, 8'h68, count[7:0], count[7:0], 8'h68};
    size = count == 3 ? 1 : 4;
    for (i = 0; i < count; i = i + 1) telegram[size + i] = body[i];
    telegram[size + count] = fcs;
    telegram[size + count + 1] = 8'h16;
    same = 0;
    for (i = 0; i < size + count + 2; i = i + 1) begin
      character = {1'b1, ^telegram[i], telegram[i], 1'b0};
      for (k = 0; k < 11; k = k + 1) begin
        if (character[k] != line) begin
          pass(same);
          same = 0;
          line = character[k];
          changes = changes + 1;
        end
        same = same + 1;
      end
    end
    pass(same + idle);
  endtask

  bytes_t cfg, exchange;
  int exchanges, done, i;
  longint earlier, answered;
  initial begin
    if (!$value$plusargs("exchanges=%d", exchanges)) $fatal(1, "+exchanges=N is missing");
    cfg = {2040'd0, 8'h3F};  // 16 bytes of inputs and outputs
    #510000 reset = 1'b1;
    u_user.wait_ready;
    u_user.initialise(SLAVE, 'h0CC9, cfg, 1, done);
    bits = $time / 83333 + 100;
    send({2024'd0, 8'h49, 8'h02, 8'h64}, 3, 1000);
    send({1952'd0, 8'h00, 8'hC9, 8'h0C, 8'h0B, 8'h00, 8'h00, 8'h80, 8'd62, 8'd61, 8'h6D, 8'h82, 8'h85}, 12, 1000);
    send({2000'd0, 8'h3F, 8'd62, 8'd62, 8'h5D, 8'h82, 8'h85}, 6, 1000);
    exchange = {1896'd0, {16{8'h5A}}, 8'h5D, 8'h02, 8'h05};
    earlier = changes;
    answered = answers;
    for (i = 0; i < exchanges; i = i + 1) begin
      exchange[2] = exchange[2] ^ 8'h20;
      send(exchange, 19, 12 + 11 * 25 + 33);
    end
    if (pbf || answers - answered != longint'(exchanges)) $fatal(1, "%0d of %0d exchanges were answered", answers - answered, exchanges);
    $display("changes\t%0d", changes - earlier);
    $finish;
  end
endmodule
