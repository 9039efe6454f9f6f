// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The PROFIBUS half of a chip: from PBRXD to PBTXD and PBRTS, and the seam to the user's side (section 2).
`include "profibus_types.svh"

module station #(
  // Capacity of the user's side and its buffers; the defaults are the protocol's limits
  parameter logic [7:0] MAX_DATA = MOST_DATA,  // inputs, outputs
  parameter logic [7:0] MAX_PRM = MOST_PRM,    // user parameters
  parameter logic [7:0] MAX_CFG = MOST_DATA    // configuration
) (
  `FAULT_PORT
  input  logic [5:0]  rts_lead_i,            // P2
  input  logic [5:0]  rts_trail_i,
  input  logic [31:0] search_window_ms_i,    // S1
  input  logic [31:0] search_window_bits_i,
  input  logic [31:0] baud_control_ms_i,
  input  logic        fcb_rule_i,            // S26
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        pbrxd_i,
  output logic        pbtxd_o,
  output logic        pbrts_o,
  output logic        br_o,
  output logic        pbf_o,
  output logic        ready_o,
  // the user's side
  input  user_commands_t commands_i,
  output user_hears_t hears_o
);
  logic rxd, restart, risen, fall, initialised, searching, found, init;
  logic [3:0] rate;

  assign init = commands_i.initialise.commit;

  synchroniser #(.POWER_ON(1'b1)) u_rxd (.clk_i(clk_i), .d_i(pbrxd_i), .q_o(rxd));

  // ---- receiver
  logic run, busy, char_valid, char_ok, char_syn, char_gap, due;
  logic [7:0] char;
  logic [5:0] clock_bits;
  logic [12:0] clock_phase;
  assign run = initialised && !pbrts_o;

  uart_rx u_uart_rx (
    `FAULT_CONNECT
    .rts_lead_i(rts_lead_i), .rts_trail_i(rts_trail_i),
    .clk_i(clk_i), .rst_ni(rst_ni), .rxd_i(rxd), .run_i(run), .rate_i(rate), .restart_rate_i(restart), .restart_rts_i(fall),
    .busy_o(busy), .valid_o(char_valid), .char_o(char), .ok_o(char_ok), .syn_o(char_syn), .gap_o(char_gap), .due_o(due),
    .clock_bits_o(clock_bits), .clock_phase_o(clock_phase));

  logic tg_begin, decide, synced, saps_ok, data_valid;
  logic [2:0] sd;
  logic [6:0] fc;
  logic [7:0] da, sa, dsap, ssap, length, fcs, data_index, data;
  logic [63:0] head;
  telegram_rx u_telegram_rx (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .restart_i(restart), .risen_i(risen), .valid_i(char_valid), .char_i(char), .ok_i(char_ok),
    .syn_i(char_syn), .gap_i(char_gap), .busy_i(busy), .due_i(due), .begin_o(tg_begin), .decide_o(decide), .sd_o(sd),
    .synced_o(synced), .da_o(da), .sa_o(sa), .fc_o(fc), .dsap_o(dsap), .ssap_o(ssap), .saps_ok_o(saps_ok),
    .length_o(length), .fcs_o(fcs), .head_o(head), .data_valid_o(data_valid), .data_index_o(data_index), .data_o(data));

  // ---- baud rate and watchdog
  logic any_telegram, trigger, trigger_holder, baud_end, dp_end, dp_control;
  logic wd_commit_dp, wd_commit_baud, wd_accept_dp, wd_accept_baud, wd_wait_prm, wd_base_1ms, search;
  logic [7:0] wd_factor_1, wd_factor_2;
  assign search = init || baud_end;

  baud_search u_baud_search (
    `FAULT_CONNECT
    .window_ms_i(search_window_ms_i), .window_bits_i(search_window_bits_i),
    .clk_i(clk_i), .rst_ni(rst_ni), .start_i(search), .telegram_i(any_telegram), .restart_o(restart), .rate_o(rate),
    .searching_o(searching), .found_o(found), .br_o(br_o));

  watchdog u_watchdog (
    `FAULT_CONNECT
    .baud_control_ms_i(baud_control_ms_i),
    .clk_i(clk_i), .rst_ni(rst_ni), .stop_i(init), .found_i(found), .commit_dp_i(wd_commit_dp),
    .commit_baud_i(wd_commit_baud), .trigger_i(trigger), .trigger_holder_i(trigger_holder), .accept_dp_i(wd_accept_dp),
    .accept_baud_i(wd_accept_baud), .wait_prm_i(wd_wait_prm), .factor_1_i(wd_factor_1), .factor_2_i(wd_factor_2),
    .base_1ms_i(wd_base_1ms), .baud_end_o(baud_end), .dp_end_o(dp_end), .dp_control_o(dp_control));

  // ---- telegrams and services: those of DPV1 are msac's, all others the DP slave's
  logic from_holder, builder_busy, send;
  logic data_exch, left, prm_dpv1, msac_replies;
  service_t service;
  answer_t answer, slave_answer, msac_answer;
  dp_status_t status;
  dp_mail_t mail;
  acyclic_mail_t c1, c2;
  logic [7:0] slave_data, msac_data, slave_mail_data, msac_mail_data, builder_index, builder_data;
  logic [7:0] send_index, send_data, send_length, min_tsdr;
  logic [31:0] answer_diag;
  logic [15:0] ident;

  fdl u_fdl (
    `FAULT_CONNECT
    .fcb_rule_i(fcb_rule_i), .clk_i(clk_i), .rst_ni(rst_ni), .decide_i(decide), .searching_i(searching), .forget_i(restart), .abort_i(init),
    .sd_i(sd), .synced_i(synced), .da_i(da), .sa_i(sa), .fc_i(fc), .dsap_i(dsap), .ssap_i(ssap), .saps_ok_i(saps_ok),
    .length_i(length), .fcs_i(fcs), .address_i(status.address), .from_holder_i(from_holder), .any_telegram_o(any_telegram),
    .trigger_o(trigger), .trigger_holder_o(trigger_holder), .service_o(service), .answer_i(answer), .answer_diag_i(answer_diag),
    .ident_i(ident), .builder_busy_o(builder_busy), .builder_index_o(builder_index), .builder_data_i(builder_data), .send_o(send),
    .send_index_i(send_index), .send_data_o(send_data), .send_length_o(send_length));

  dp_slave #(.MAX_DATA(MAX_DATA), .MAX_PRM(MAX_PRM), .MAX_CFG(MAX_CFG)) u_dp_slave (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .commands_i(commands_i), .mail_o(mail), .mail_data_o(slave_mail_data), .status_o(status),
    .pbf_o(pbf_o), .dp_end_i(dp_end), .dp_control_i(dp_control), .wd_commit_dp_o(wd_commit_dp), .wd_commit_baud_o(wd_commit_baud),
    .wd_accept_dp_o(wd_accept_dp), .wd_accept_baud_o(wd_accept_baud), .wd_wait_prm_o(wd_wait_prm),
    .wd_factor_1_o(wd_factor_1), .wd_factor_2_o(wd_factor_2), .wd_base_1ms_o(wd_base_1ms),
    .begin_i(tg_begin), .data_valid_i(data_valid), .data_index_i(data_index), .data_i(data), .head_i(head),
    .length_i(length), .sa_i(sa[6:0]), .service_i(service), .dsap_i(dsap), .from_holder_o(from_holder), .data_exch_o(data_exch),
    .left_o(left), .dpv1_o(prm_dpv1), .answer_o(slave_answer), .answer_diag_o(answer_diag), .ident_o(ident),
    .min_tsdr_o(min_tsdr), .answer_busy_i(builder_busy), .answer_index_i(builder_index), .answer_data_o(slave_data));

  msac u_msac (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .init_i(init), .left_i(left), .data_exch_i(data_exch), .from_holder_i(from_holder),
    .prm_dpv1_i(prm_dpv1), .dpv1_on_i(commands_i.dpv1_on), .data_valid_i(data_valid), .data_index_i(data_index), .data_i(data),
    .head_i(head), .length_i(length), .sa_i(sa), .ssap_i(ssap), .dsap_i(dsap), .service_i(service), .replies_o(msac_replies),
    .reply_o(msac_answer), .reply_index_i(builder_index), .reply_data_o(msac_data), .c1_o(c1), .c2_o(c2),
    .answers_i(commands_i.answers), .stage_i(commands_i.stage), .take_i(commands_i.take), .mail_data_o(msac_mail_data));

  assign answer = msac_replies ? msac_answer : slave_answer;

  // Selects the bytes for the builder and the user's side
  logic msac_built_q, msac_mail_q;
  always_ff @(posedge clk_i) begin
    if (send) msac_built_q <= msac_replies;
    if (commands_i.take.c1 || commands_i.take.c2) msac_mail_q <= 1'b1;
    else if (commands_i.take.parameters || commands_i.take.configuration || commands_i.take.outputs) msac_mail_q <= 1'b0;
  end
  assign builder_data = msac_built_q ? msac_data : slave_data;

  uart_tx u_uart_tx (
    `FAULT_CONNECT
    .rts_lead_i(rts_lead_i), .rts_trail_i(rts_trail_i),
    .clk_i(clk_i), .rst_ni(rst_ni), .abort_i(init), .send_i(send), .rate_i(rate), .min_tsdr_i(min_tsdr),
    .clock_bits_i(clock_bits), .clock_phase_i(clock_phase), .index_o(send_index), .data_i(send_data),
    .length_i(send_length), .risen_o(risen), .fall_o(fall), .pbtxd_o(pbtxd_o), .pbrts_o(pbrts_o));

  assign initialised = status.initialised;
  assign ready_o = initialised;
  assign hears_o.mail = mail;
  assign hears_o.c1 = c1;
  assign hears_o.c2 = c2;
  assign hears_o.status = status;
  assign hears_o.baud = {!searching, rate};
  assign hears_o.data = msac_mail_q ? msac_mail_data : slave_mail_data;
endmodule
