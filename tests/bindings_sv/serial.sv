// A host at the serial ports of the DSDPV1-RSU: it reads B004, ready, by a read telegram through SPI (+mode=1) or the UART (+mode=2), and
// checks that the reply is C5 with the right CRC. The chip is the library's model, with a checker; with USE_RTL defined the reference RTL,
// with a scoreboard and the bound assertions, and +fault= plants a defect in it. +short_clock: the host's SCK is high for 40 ns, although
// SP2 requires 50.
`ifdef USE_RTL
`include "dsdpv1_rsu_types.svh"
`endif

module serial;
  timeunit 1ps;
  timeprecision 1ps;

  wire clk;
  dsdpv1_clock u_clock (.clk_o(clk));

  logic reset = 1'b0, xss = 1'b1, sck = 1'b0, mosi = 1'b0, rxd = 1'b1;
  logic [1:0] mode = 2'd1;
  wire l_req, l_sta, d_oe, intr0, pbtxd, pbrts, pbf, br, ready, miso, miso_oe, txd;
  wire [7:0] d_out;
`define PINS \
    .reset_i(reset), .clk_i(clk), .pbrxd_i(1'b1), .pbtxd_o(pbtxd), .pbrts_o(pbrts), .r_req_i(1'b0), .r_sta_i(1'b0), .l_req_o(l_req), \
    .l_sta_o(l_sta), .a_i(11'd0), .d_i(8'hzz), .d_o(d_out), .d_oe_o(d_oe), .csr_i(1'b1), .rd_i(1'b1), .wr_i(1'b1), .intr0_o(intr0), \
    .pbf_o(pbf), .br_o(br), .ready_o(ready), .mode_i(mode), .adr_i(2'd1), .ubr_i(3'd7), .uiv_i(3'd0), .xss_i(xss), .sck_i(sck), \
    .mosi_i(mosi), .miso_o(miso), .miso_oe_o(miso_oe), .rxd_i(rxd), .txd_o(txd)
`ifdef USE_RTL
  reg [7:0] fault = 8'd0;
  dsdpv1_rsu u_chip (.fault_i(fault), `PINS);
  dsdpv1_rsu_scoreboard u_scoreboard (`PINS);
`else
  dsdpv1_rsu_model u_chip (`PINS);
`endif
  dsdpv1_rsu_checker #(.QUIET(1)) u_checker (`PINS);

  // ---- the host
  localparam int REQUEST = 6, REPLY = 5, BIT = 541667;  // 1.8432 Mbit/s: 26 cycles
  logic [47:0] request = 48'h010004_01D8C2;
  logic [39:0] wanted = 40'h8100C5_0000;
  logic [39:0] got = 40'd0;

  function logic [15:0] crc16(input logic [15:0] crc, input logic [7:0] value);
    integer shift;
    crc16 = crc ^ {8'h00, value};
    for (shift = 0; shift < 8; shift = shift + 1) crc16 = crc16[0] ? (crc16 >> 1) ^ 16'hA001 : crc16 >> 1;
  endfunction

  int high;
  task spi_frame;
    int i;
    high = $test$plusargs("short_clock") ? 40000 : 60000;
    xss = 1'b0;
    #100000;
    for (i = 0; i < 8 * (REQUEST + REPLY); i = i + 1) begin
      mosi = i < 8 * REQUEST ? request[47 - i] : 1'b1;
      #60000 sck = 1'b1;
      if (i >= 8 * REQUEST) got = {got[38:0], miso_oe ? miso : 1'b0};
      #(high) sck = 1'b0;
    end
    #100000 xss = 1'b1;
    #100000 if (miso_oe) $fatal(1, "MISO is driven without XSS");
  endtask

  task send_character(input [7:0] value);
    int i;
    logic [10:0] bits;
    bits = {1'b1, ^value, value, 1'b0};
    for (i = 0; i < 11; i = i + 1) begin
      rxd = bits[i];
      #(BIT);
    end
  endtask

  task receive_character;
    int i;
    logic [10:0] bits;
    wait (!txd);
    #(BIT / 2);
    for (i = 0; i < 11; i = i + 1) begin
      bits[i] = txd;
      if (i < 10) #(BIT);
    end
    if (bits[0] || !bits[10] || ^bits[9:1]) $fatal(1, "a character of the reply is wrong: %b", bits);
    got = {got[31:0], bits[8:1]};
  endtask

  task uart_telegram;
    int i;
    for (i = 0; i < REQUEST; i = i + 1) send_character(request[8 * (REQUEST - 1 - i) +: 8]);
    for (i = 0; i < REPLY; i = i + 1) receive_character();
  endtask

  int i;
  logic [15:0] crc;
  initial begin
`ifdef USE_RTL
    if (!$value$plusargs("fault=%d", fault)) fault = 8'd0;
`endif
    if (!$value$plusargs("mode=%d", mode)) mode = 2'd1;
    crc = 16'hFFFF;
    for (i = 0; i < 3; i = i + 1) crc = crc16(crc, wanted[39 - 8 * i -: 8]);
    wanted[15:0] = crc;
    #500003 reset = 1'b1;
    #200000000;  // B004 is due after READY_CYCLES, 85 us
    if (mode == 2'd1) spi_frame();
    else uart_telegram();
    #10000000;
    $display("reply %h", got);
    if (got != wanted) $fatal(1, "the reply is %h, it should be %h", got, wanted);
    u_checker.finish;
    $display("violations %0d, rules applied %0d times", u_checker.violations, u_checker.applied);
`ifdef USE_RTL
    $display("the scoreboard has seen %0d changes, all alike", u_scoreboard.matched());
`endif
    $display("passed");
    $finish;
  end
endmodule
