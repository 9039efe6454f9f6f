// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The chip: PROFIBUS half, DPRAM and the user's side (section 2). Pins as in table 1; D is split into d_i, d_o and d_oe_o.
`include "dsdpv1_types.svh"

`ifdef DSDPV1_RUN_TIME_LIMITS
module dsdpv1 (
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
`else
module dsdpv1 #(
  parameter integer ACCESS_INTERVAL = 48,       // cycles from one DPRAM access to the next (H1)
  parameter integer READY_CYCLES = 4096,        // from R until B004 is due (D1)
  parameter integer RTS_LEAD = 4,               // P2; 0 to 32
  parameter integer RTS_TRAIL = 4,              // P2; 0 to 32
  parameter integer INTR_LOW = 64,              // P7
  parameter integer INTR_GAP = 64,              // P7
  parameter integer SEARCH_WINDOW_MS = 50,      // S1
  parameter integer SEARCH_WINDOW_BITS = 4000,  // S1
  parameter integer BAUD_CONTROL_MS = 600,      // S1
  parameter integer FCB_RULE = 0                // S26; 0 letter, 1 content
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
  output logic        ready_o
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

  logic user_holds, chip_owns;
  handshake u_handshake (
    `FAULT_CONNECT
    .clk_i(clk_i), .r_req_i(r_req_i), .r_sta_i(r_sta_i), .l_req_o(l_req_o), .l_sta_o(l_sta_o), .user_holds_o(user_holds),
    .owns_i(chip_owns));

  logic user_we, chip_we;
  logic [10:0] user_waddr, user_raddr, chip_addr;
  logic [7:0] user_wdata, chip_wdata, rdata;

  host_port u_host_port (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_n), .csr_i(csr_i), .rd_i(rd_i), .wr_i(wr_i), .a_i(a_i), .d_i(d_i), .d_o(d_o),
    .d_oe_o(d_oe_o), .we_o(user_we), .waddr_o(user_waddr), .wdata_o(user_wdata), .raddr_o(user_raddr), .rdata_i(rdata));

  dpram u_dpram (
`ifdef SINGLE_FAULTS
    `FAULT_CONNECT
`endif
    .clk_i(clk_i), .rst_ni(rst_n), .user_we_i(user_we), .user_waddr_i(user_waddr), .user_wdata_i(user_wdata),
    .user_raddr_i(user_raddr), .chip_owns_i(chip_owns), .chip_we_i(chip_we), .chip_addr_i(chip_addr),
    .chip_wdata_i(chip_wdata), .rdata_o(rdata));

  // ---- the seam between the two halves
  user_commands_t commands;
  user_hears_t hears;
  logic interrupt_flag;

  dpram_sequencer u_sequencer (
    `FAULT_CONNECT
    .access_interval_i(access_interval[12:0]), .ready_cycles_i(ready_cycles[20:0]), .clk_i(clk_i), .rst_ni(rst_n),
    .user_holds_i(user_holds), .owns_o(chip_owns), .interrupt_o(interrupt_flag), .we_o(chip_we), .addr_o(chip_addr),
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
