// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// DSDPV1-RSU: the DSDPV1 with two more host ports, SPI and UART, of which straps choose one (R1, R11). Pins as in table 1, and those of R2;
// D is split into d_i, d_o and d_oe_o, MISO into miso_o and miso_oe_o.
`include "dsdpv1_rsu_types.svh"

`ifdef DSDPV1_RUN_TIME_LIMITS
module dsdpv1_rsu (
  input  logic [31:0] access_interval_i,     // as the parameters of these names below
  input  logic [31:0] ready_cycles_i,
  input  logic [31:0] rts_lead_i,
  input  logic [31:0] rts_trail_i,
  input  logic [31:0] intr_low_i,
  input  logic [31:0] intr_gap_i,
  input  logic [31:0] search_window_ms_i,
  input  logic [31:0] search_window_bits_i,
  input  logic [31:0] baud_control_ms_i,
  input  logic [31:0] fcb_rule_i,
  input  logic [31:0] spi_reply_gap_i,
  input  logic [31:0] spi_write_gap_i,
  input  logic [31:0] serial_block_crc_i,
  input  logic [31:0] u_timer_i,
  input  logic [127:0] uart_gaps_i,
  input  logic [31:0] uart_min_tsdr_i,
  input  logic [31:0] uart_cfg_length_i,
`else
module dsdpv1_rsu #(
  parameter integer ACCESS_INTERVAL = 48,       // cycles from one DPRAM access to the next (H1)
  parameter integer READY_CYCLES = 4096,        // from R until B004 is due (D1)
  parameter integer RTS_LEAD = 4,               // P2; 0 to 32
  parameter integer RTS_TRAIL = 4,              // P2; 0 to 32
  parameter integer INTR_LOW = 64,              // P7
  parameter integer INTR_GAP = 64,              // P7
  parameter integer SEARCH_WINDOW_MS = 50,      // S1
  parameter integer SEARCH_WINDOW_BITS = 4000,  // S1
  parameter integer BAUD_CONTROL_MS = 600,      // S1
  parameter integer FCB_RULE = 0,               // S26; 0 letter, 1 content
  parameter integer SPI_REPLY_GAP = 0,          // bytes (SP6); 0 to 16
  parameter integer SPI_WRITE_GAP = 128,        // cycles (SP9); 0 to 4800
  parameter integer SERIAL_BLOCK_CRC = 0,       // 1: block CRCs are judged in SPI and UART mode, too (SP15)
  parameter integer U_TIMER = 0,                // cycles (SP17); 0: none, or 48 to 4 800 000
  parameter logic [127:0] UART_GAPS = {         // half characters (UA3), 16 bits each, code 0 lowest; 1 to 1000
    16'd200, 16'd100, 16'd40, 16'd20, 16'd10, 16'd4, 16'd2, 16'd7},
  parameter integer UART_MIN_TSDR = 11,         // bit times (UA4); 1 to 255
  parameter integer UART_CFG_LENGTH = 0         // UA12; 0 or 1
) (
`endif
  `FAULT_PORT
  input  logic        reset_i,
  input  logic        clk_i,
  input  logic        pbrxd_i,
  output logic        pbtxd_o,
  output logic        pbrts_o,
  input  logic        r_req_i,
  input  logic        r_sta_i,
  output logic        l_req_o,
  output logic        l_sta_o,
  input  logic [10:0] a_i,
  input  logic [7:0]  d_i,
  output logic [7:0]  d_o,
  output logic        d_oe_o,
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
  // SPI
  input  logic        xss_i,
  input  logic        sck_i,
  input  logic        mosi_i,
  output logic        miso_o,
  output logic        miso_oe_o,
  // UART
  input  logic        rxd_i,
  output logic        txd_o
);
  // RESET: asynchronous in, synchronous release (P1, P9). The first active edge is R = m+2.
  logic [1:0] release_q;
  logic rst_n;
  always_ff @(posedge clk_i or negedge reset_i) begin
    if (!reset_i) release_q <= 2'b00;
    else release_q <= {release_q[0], 1'b1};
  end
  assign rst_n = release_q[1];

  /* verilator lint_off UNUSEDSIGNAL */  // the upper bits of most
  logic [31:0] access_interval, ready_cycles, rts_lead, rts_trail, intr_low, intr_gap, fcb_rule;
  logic [31:0] spi_reply_gap, spi_write_gap, serial_block_crc, u_timer, uart_min_tsdr, uart_cfg_length;
  /* verilator lint_on UNUSEDSIGNAL */
  logic [31:0] search_window_ms, search_window_bits, baud_control_ms;
  assign access_interval = `LIMIT(ACCESS_INTERVAL, access_interval_i);
  assign ready_cycles = `LIMIT(READY_CYCLES, ready_cycles_i);
  assign rts_lead = `LIMIT(RTS_LEAD, rts_lead_i);
  assign rts_trail = `LIMIT(RTS_TRAIL, rts_trail_i);
  assign intr_low = `LIMIT(INTR_LOW, intr_low_i);
  assign intr_gap = `LIMIT(INTR_GAP, intr_gap_i);
  assign search_window_ms = `LIMIT(SEARCH_WINDOW_MS, search_window_ms_i);
  assign search_window_bits = `LIMIT(SEARCH_WINDOW_BITS, search_window_bits_i);
  assign baud_control_ms = `LIMIT(BAUD_CONTROL_MS, baud_control_ms_i);
  assign fcb_rule = `LIMIT(FCB_RULE, fcb_rule_i);

  assign spi_reply_gap = `LIMIT(SPI_REPLY_GAP, spi_reply_gap_i);
  assign spi_write_gap = `LIMIT(SPI_WRITE_GAP, spi_write_gap_i);
  assign serial_block_crc = `LIMIT(SERIAL_BLOCK_CRC, serial_block_crc_i);
  assign u_timer = `LIMIT(U_TIMER, u_timer_i);
  assign uart_min_tsdr = `LIMIT(UART_MIN_TSDR, uart_min_tsdr_i);
  assign uart_cfg_length = `LIMIT(UART_CFG_LENGTH, uart_cfg_length_i);
  logic [127:0] uart_gaps;
  assign uart_gaps = `LIMIT(UART_GAPS, uart_gaps_i);

  logic begins, spi, uart, serial, closed;
  logic [1:0] adr;
  logic [2:0] ubr, uiv;
  straps u_straps (
    .clk_i(clk_i), .rst_ni(rst_n), .mode_i(mode_i), .adr_i(adr_i), .ubr_i(ubr_i), .uiv_i(uiv_i), .begins_o(begins), .spi_o(spi),
    .uart_o(uart), .closed_o(closed), .adr_o(adr), .ubr_o(ubr), .uiv_o(uiv));
  assign serial = spi || uart;

  // ---- the parallel port: dead in the other modes (R14). Up to R it listens in none, so registers alone close it.
  logic user_holds, chip_owns;
  handshake u_handshake (
    `FAULT_CONNECT
    .clk_i(clk_i), .r_req_i(r_req_i), .r_sta_i(r_sta_i), .l_req_o(l_req_o), .l_sta_o(l_sta_o), .user_holds_o(user_holds),
    .owns_i(chip_owns && !closed));

  logic user_we, host_we, chip_we;
  logic [10:0] user_waddr, host_waddr, user_raddr, chip_addr;
  logic [7:0] user_wdata, host_wdata, chip_wdata, rdata;

  host_port u_host_port (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_n), .csr_i(csr_i || closed), .rd_i(rd_i), .wr_i(wr_i), .a_i(a_i), .d_i(d_i), .d_o(d_o),
    .d_oe_o(d_oe_o), .we_o(user_we), .waddr_o(user_waddr), .wdata_o(user_wdata), .raddr_o(user_raddr), .rdata_i(rdata));

  dpram u_dpram (
`ifdef SINGLE_FAULTS
    `FAULT_CONNECT
`endif
    .clk_i(clk_i), .rst_ni(rst_n), .user_we_i(serial ? host_we : user_we), .user_waddr_i(serial ? host_waddr : user_waddr),
    .user_wdata_i(serial ? host_wdata : user_wdata),
    .user_raddr_i(user_raddr), .chip_owns_i(chip_owns), .chip_we_i(chip_we), .chip_addr_i(chip_addr),
    .chip_wdata_i(chip_wdata), .rdata_o(rdata));

  // ---- the seam between the two halves
  user_commands_t commands;
  user_hears_t hears;
  logic interrupt_flag;

  // ---- the serial ports
  logic host_holds, host_owns;
  /* verilator lint_off UNUSEDSIGNAL */  // for external views of the DPRAM alone
  logic [7:0] b014;  // for external views of the DPRAM: with SPI a register instead of the cell (5.4)
  /* verilator lint_on UNUSEDSIGNAL */
  assign b014 = {6'd0, host_owns, spi && chip_owns};
  serial_port u_serial_port (
    `FAULT_CONNECT
    .spi_reply_gap_i(spi_reply_gap[4:0]), .spi_write_gap_i(spi_write_gap[12:0]), .u_timer_i(u_timer[22:0]), .uart_gaps_i(uart_gaps),
    .uart_min_tsdr_i(uart_min_tsdr[7:0]), .uart_cfg_length_i(uart_cfg_length[0]), .clk_i(clk_i), .rst_ni(rst_n), .begins_i(begins),
    .spi_i(spi), .uart_i(uart), .adr_i(adr), .ubr_i(ubr), .uiv_i(uiv), .xss_i(xss_i), .sck_i(sck_i), .mosi_i(mosi_i), .miso_o(miso_o),
    .miso_oe_o(miso_oe_o), .rxd_i(rxd_i), .txd_o(txd_o), .holds_o(host_holds), .host_owns_o(host_owns), .owns_i(chip_owns),
    .exchanges_i(hears.status.state == DP_DATA_EXCH), .chip_we_i(chip_we), .chip_addr_i(chip_addr), .chip_wdata_i(chip_wdata),
    .we_o(host_we), .waddr_o(host_waddr), .wdata_o(host_wdata));

  dpram_sequencer u_sequencer (
    `FAULT_CONNECT
    .access_interval_i(access_interval[12:0]), .ready_cycles_i(ready_cycles[20:0]), .clk_i(clk_i), .rst_ni(rst_n),
    .user_holds_i(serial ? host_holds : user_holds), .crc_counts_i(!serial || serial_block_crc[0] || `FAULT(152)), .owns_o(chip_owns), .interrupt_o(interrupt_flag), .we_o(chip_we), .addr_o(chip_addr),
    .wdata_o(chip_wdata), .rdata_i(rdata), .commands_o(commands), .hears_i(hears));

  station #(
    .MAX_DATA(DSDPV1_REG_INIT_MAX_INPUT_LIMIT), .MAX_PRM(DSDPV1_REG_INIT_MAX_PRM_LIMIT), .MAX_CFG(DSDPV1_REG_INIT_MAX_CFG_LIMIT)
  ) u_station (
    `FAULT_CONNECT
    .rts_lead_i(rts_lead[5:0]), .rts_trail_i(rts_trail[5:0]), .search_window_ms_i(search_window_ms),
    .search_window_bits_i(search_window_bits), .baud_control_ms_i(baud_control_ms), .fcb_rule_i(fcb_rule[0]), .clk_i(clk_i), .rst_ni(rst_n),
    .pbrxd_i(pbrxd_i), .pbtxd_o(pbtxd_o), .pbrts_o(pbrts_o), .br_o(br_o), .pbf_o(pbf_o), .ready_o(ready_o),
    .commands_i(commands), .hears_o(hears));

  interrupt u_interrupt (
    `FAULT_CONNECT
    .low_i(intr_low[13:0]), .gap_i(intr_gap[13:0]), .clk_i(clk_i), .rst_ni(rst_n), .flag_i(interrupt_flag), .intr0_o(intr0_o));
endmodule
