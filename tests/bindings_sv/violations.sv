// The rules of the user's side on directly moved pins: one hold in which B006 is read and written. +short is a write strobe of 5 ns,
// although table 15 requires 12.5.
module violations;
  timeunit 1ps;
  timeprecision 1ps;
  logic reset_i = 1'b0, r_req_i = 1'b0, r_sta_i = 1'b0, csr_i = 1'b1, rd_i = 1'b1, wr_i = 1'b1, d_oe_o = 1'b0;
  logic [10:0] a_i = 11'd0;
  logic [7:0] d_i = 8'hzz, d_o = 8'h00;
  wire clk_i;
  wire pbrxd_i = 1'b1, pbtxd_o = 1'b1, pbrts_o = 1'b0, l_req_o = 1'b0, l_sta_o = 1'b0, intr0_o = 1'b1, pbf_o = 1'b1, br_o = 1'b0, ready_o = 1'b1;
  dsdpv1_clock u_clock (.clk_o(clk_i));
  dsdpv1_checker u_checker (.*);

  int strobe;
  initial begin
    strobe = $test$plusargs("short") ? 5000 : 40000;
    #1000000 reset_i = 1'b1;
    #200000000 r_req_i = 1'b1;
    #200000 r_sta_i = 1'b1;
    #100000 a_i = 11'h006;
    csr_i = 1'b0;
    #10000 rd_i = 1'b0;
    {d_oe_o, d_o} = {1'b1, 8'h01};
    #60000 rd_i = 1'b1;
    {csr_i, d_oe_o} = 2'b10;
    #100000 csr_i = 1'b0;
    #10000 d_i = 8'h02;
    #(50000 - strobe) wr_i = 1'b0;
    #(strobe) wr_i = 1'b1;
    #20000 csr_i = 1'b1;
    d_i = 8'hzz;
    #100000 r_sta_i = 1'b0;
    r_req_i = 1'b0;
    #10000000 u_checker.finish;
    $display("violations %0d, rules applied %0d times", u_checker.violations, u_checker.applied);
    $finish;
  end
endmodule
