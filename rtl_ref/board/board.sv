// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The DSDPV1-RSU on an iCE40-HX8K breakout board: 48 MHz from the board's 12 MHz, D and MISO as tri-state cells, global buffers for WR and SCK.
//
// Built up to a bitstream by build.sh; run on no board (docs/hardware.md). Pins: board.pcf.
module board (
  input  logic        clk_12m_i,
  input  logic        reset_i,
  // PROFIBUS, to a transceiver of RS485
  input  logic        pbrxd_i,
  output logic        pbtxd_o,
  output logic        pbrts_o,
  // parallel port
  input  logic        r_req_i,
  input  logic        r_sta_i,
  output logic        l_req_o,
  output logic        l_sta_o,
  input  logic [10:0] a_i,
  inout  wire  [7:0]  d_io,
  input  logic        csr_i,
  input  logic        rd_i,
  input  logic        wr_i,
  output logic        intr0_o,
  output logic        pbf_o,
  output logic        br_o,
  output logic        ready_o,
  // straps
  input  logic [1:0]  mode_i,
  input  logic [1:0]  adr_i,
  input  logic [2:0]  ubr_i,
  input  logic [2:0]  uiv_i,
  // serial ports
  input  logic        xss_i,
  input  logic        sck_i,
  input  logic        mosi_i,
  inout  wire         miso_io,
  input  logic        rxd_i,
  output logic        txd_o
);
  // ---- CLK: 12 MHz * 64 / 16
  logic clk, locked, reset;
  SB_PLL40_CORE #(
    .FEEDBACK_PATH("SIMPLE"), .PLLOUT_SELECT("GENCLK"), .DIVR(4'd0), .DIVF(7'd63), .DIVQ(3'd4), .FILTER_RANGE(3'd1)
  ) u_pll (
    .REFERENCECLK(clk_12m_i), .PLLOUTCORE(), .PLLOUTGLOBAL(clk), .LOCK(locked), .RESETB(1'b1), .BYPASS(1'b0));
  assign reset = reset_i && locked;  // CLK is not used before

  // ---- the other clocks
  logic wr, sck;
  SB_GB u_wr (.USER_SIGNAL_TO_GLOBAL_BUFFER(wr_i), .GLOBAL_BUFFER_OUTPUT(wr));
  SB_GB u_sck (.USER_SIGNAL_TO_GLOBAL_BUFFER(sck_i), .GLOBAL_BUFFER_OUTPUT(sck));

  // ---- pins of both directions: an output with an enable, and an input
  logic [7:0] d_in, d_out;
  logic d_oe, miso, miso_oe;
  genvar bit_number;
  generate
    for (bit_number = 0; bit_number < 8; bit_number = bit_number + 1) begin : g_d
      SB_IO #(.PIN_TYPE(6'b101001)) u_io (
        .PACKAGE_PIN(d_io[bit_number]), .OUTPUT_ENABLE(d_oe), .D_OUT_0(d_out[bit_number]), .D_IN_0(d_in[bit_number]));
    end
  endgenerate
  SB_IO #(.PIN_TYPE(6'b101001)) u_miso (.PACKAGE_PIN(miso_io), .OUTPUT_ENABLE(miso_oe), .D_OUT_0(miso), .D_IN_0());

  dsdpv1_rsu u_chip (
    .reset_i(reset), .clk_i(clk), .pbrxd_i(pbrxd_i), .pbtxd_o(pbtxd_o), .pbrts_o(pbrts_o), .r_req_i(r_req_i), .r_sta_i(r_sta_i),
    .l_req_o(l_req_o), .l_sta_o(l_sta_o), .a_i(a_i), .d_i(d_in), .d_o(d_out), .d_oe_o(d_oe), .csr_i(csr_i), .rd_i(rd_i), .wr_i(wr),
    .intr0_o(intr0_o), .pbf_o(pbf_o), .br_o(br_o), .ready_o(ready_o), .mode_i(mode_i), .adr_i(adr_i), .ubr_i(ubr_i), .uiv_i(uiv_i),
    .xss_i(xss_i), .sck_i(sck), .mosi_i(mosi_i), .miso_o(miso), .miso_oe_o(miso_oe), .rxd_i(rxd_i), .txd_o(txd_o));
endmodule
