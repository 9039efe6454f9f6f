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
  parameter integer BAUD_CONTROL_MS = 600       // S1
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

  /* verilator lint_off UNUSED */  // the upper bits of most
  logic [31:0] access_interval, ready_cycles, rts_lead, rts_trail, intr_low, intr_gap;
  /* verilator lint_on UNUSED */
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

  logic r_req, r_sta, r_sta_seen;
  synchroniser #(.POWER_ON(1'b0)) u_r_req (.clk_i(clk_i), .d_i(r_req_i), .q_o(r_req));
  synchroniser #(.POWER_ON(1'b0)) u_r_sta (.clk_i(clk_i), .d_i(r_sta_i), .q_o(r_sta_seen));
  assign r_sta = `FAULT(96) ? r_sta_i : r_sta_seen;

  logic user_we, chip_we, l_sta;
  logic [10:0] user_waddr, user_raddr, chip_addr;
  logic [7:0] user_wdata, chip_wdata, rdata;

  host_port u_host_port (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_n), .csr_i(csr_i), .rd_i(rd_i), .wr_i(wr_i), .a_i(a_i), .d_i(d_i), .d_o(d_o),
    .d_oe_o(d_oe_o), .we_o(user_we), .waddr_o(user_waddr), .wdata_o(user_wdata), .raddr_o(user_raddr), .rdata_i(rdata));

  dpram u_dpram (
    .clk_i(clk_i), .rst_ni(rst_n), .user_we_i(user_we), .user_waddr_i(user_waddr), .user_wdata_i(user_wdata),
    .user_raddr_i(user_raddr), .chip_owns_i(l_sta), .chip_we_i(chip_we), .chip_addr_i(chip_addr),
    .chip_wdata_i(chip_wdata), .rdata_o(rdata));
  assign l_sta_o = l_sta;

  logic init, inputs, diag, verdict_prm, verdict_cfg, verdict_wrong, dpv1_on, interrupt_flag;
  logic c1_answer, c2_answer, c1_mail, c2_mail, take_c1, take_c2, stage_c1, stage_c2, stage_msac_we;
  logic [7:0] c1_function, c2_function, c1_length, c2_length;
  logic stage_inputs, stage_diag, stage_we, initialised, prm_mail, cfg_mail, output_mail, take_prm, take_cfg, take_output;
  logic [1:0] init_prm_mode, init_cfg_mode, stage_pool;
  logic [3:0] init_command;
  logic [6:0] init_address;
  logic [15:0] init_ident, count;
  logic [7:0] init_max_input, init_max_output, init_max_diag, init_max_prm, init_max_cfg, init_cfg_length;
  logic [7:0] init_input_length, init_output_length;
  logic [7:0] block_length, diag_type, stage_index, stage_data, status;
  logic [7:0] prm_length, cfg_length, cfg_input_length, cfg_output_length, output_length, transfer_index, transfer_data;

  dpram_sequencer u_sequencer (
    `FAULT_CONNECT
    .access_interval_i(access_interval[12:0]), .ready_cycles_i(ready_cycles[20:0]),
    .clk_i(clk_i), .rst_ni(rst_n), .r_req_i(r_req), .r_sta_i(r_sta), .l_req_o(l_req_o), .l_sta_o(l_sta), .interrupt_o(interrupt_flag),
    .we_o(chip_we), .addr_o(chip_addr), .wdata_o(chip_wdata), .rdata_i(rdata),
    .init_o(init), .init_address_o(init_address), .init_ident_o(init_ident), .init_command_o(init_command),
    .init_max_input_o(init_max_input), .init_max_output_o(init_max_output), .init_max_diag_o(init_max_diag),
    .init_max_prm_o(init_max_prm), .init_prm_mode_o(init_prm_mode), .init_max_cfg_o(init_max_cfg),
    .init_cfg_mode_o(init_cfg_mode), .init_cfg_length_o(init_cfg_length), .init_input_length_o(init_input_length),
    .init_output_length_o(init_output_length), .inputs_o(inputs), .diag_o(diag), .c1_answer_o(c1_answer), .c2_answer_o(c2_answer),
    .block_length_o(block_length), .diag_type_o(diag_type), .verdict_prm_o(verdict_prm), .verdict_cfg_o(verdict_cfg),
    .verdict_wrong_o(verdict_wrong), .dpv1_on_o(dpv1_on), .stage_inputs_o(stage_inputs),
    .stage_diag_o(stage_diag), .stage_c1_o(stage_c1), .stage_c2_o(stage_c2), .stage_we_o(stage_we), .stage_msac_we_o(stage_msac_we),
    .stage_pool_o(stage_pool), .stage_index_o(stage_index),
    .stage_data_o(stage_data), .initialised_i(initialised), .status_i(status), .count_i(count), .prm_mail_i(prm_mail),
    .cfg_mail_i(cfg_mail), .output_mail_i(output_mail), .c1_mail_i(c1_mail), .c2_mail_i(c2_mail), .prm_length_i(prm_length), .cfg_length_i(cfg_length),
    .cfg_input_length_i(cfg_input_length), .cfg_output_length_i(cfg_output_length), .output_length_i(output_length),
    .c1_function_i(c1_function), .c2_function_i(c2_function), .c1_length_i(c1_length), .c2_length_i(c2_length),
    .take_prm_o(take_prm), .take_cfg_o(take_cfg), .take_output_o(take_output), .take_c1_o(take_c1), .take_c2_o(take_c2), .transfer_index_o(transfer_index),
    .transfer_data_i(transfer_data));

  station u_station (
    `FAULT_CONNECT
    .rts_lead_i(rts_lead[5:0]), .rts_trail_i(rts_trail[5:0]), .search_window_ms_i(search_window_ms),
    .search_window_bits_i(search_window_bits), .baud_control_ms_i(baud_control_ms),
    .clk_i(clk_i), .rst_ni(rst_n), .pbrxd_i(pbrxd_i), .pbtxd_o(pbtxd_o), .pbrts_o(pbrts_o), .br_o(br_o), .pbf_o(pbf_o),
    .ready_o(ready_o), .init_i(init), .init_address_i(init_address), .init_ident_i(init_ident),
    .init_command_i(init_command), .init_max_input_i(init_max_input), .init_max_output_i(init_max_output),
    .init_max_diag_i(init_max_diag), .init_max_prm_i(init_max_prm), .init_prm_mode_i(init_prm_mode),
    .init_max_cfg_i(init_max_cfg), .init_cfg_mode_i(init_cfg_mode), .init_cfg_length_i(init_cfg_length),
    .init_input_length_i(init_input_length), .init_output_length_i(init_output_length),
    .inputs_i(inputs), .inputs_length_i(block_length), .diag_i(diag), .diag_type_i(diag_type),
    .diag_length_i(block_length), .verdict_prm_i(verdict_prm), .verdict_cfg_i(verdict_cfg),
    .verdict_wrong_i(verdict_wrong), .dpv1_on_i(dpv1_on), .c1_answer_i(c1_answer), .c2_answer_i(c2_answer),
    .answer_length_i(block_length), .stage_inputs_i(stage_inputs),
    .stage_diag_i(stage_diag), .stage_c1_i(stage_c1), .stage_c2_i(stage_c2), .stage_we_i(stage_we), .stage_msac_we_i(stage_msac_we),
    .stage_pool_i(stage_pool), .stage_index_i(stage_index),
    .stage_data_i(stage_data), .initialised_o(initialised), .status_o(status), .count_o(count), .prm_mail_o(prm_mail),
    .cfg_mail_o(cfg_mail), .output_mail_o(output_mail), .c1_mail_o(c1_mail), .c2_mail_o(c2_mail), .prm_length_o(prm_length), .cfg_length_o(cfg_length),
    .cfg_input_length_o(cfg_input_length), .cfg_output_length_o(cfg_output_length), .output_length_o(output_length),
    .c1_function_o(c1_function), .c2_function_o(c2_function), .c1_length_o(c1_length), .c2_length_o(c2_length),
    .take_prm_i(take_prm), .take_cfg_i(take_cfg), .take_output_i(take_output), .take_c1_i(take_c1), .take_c2_i(take_c2), .transfer_index_i(transfer_index),
    .transfer_data_o(transfer_data));

  interrupt u_interrupt (
    `FAULT_CONNECT
    .low_i(intr_low[13:0]), .gap_i(intr_gap[13:0]), .clk_i(clk_i), .rst_ni(rst_n), .flag_i(interrupt_flag), .intr0_o(intr0_o));
endmodule
