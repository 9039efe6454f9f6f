// The PROFIBUS half of the chip: from PBRXD to PBTXD and PBRTS, and the side that faces the user (section 2).
`include "dsdpv1_types.svh"

module station (
  `FAULT_PORT
  input  logic [5:0]  rts_lead_i,            // P2
  input  logic [5:0]  rts_trail_i,
  input  logic [31:0] search_window_ms_i,    // S1
  input  logic [31:0] search_window_bits_i,
  input  logic [31:0] baud_control_ms_i,
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        pbrxd_i,
  output logic        pbtxd_o,
  output logic        pbrts_o,
  output logic        br_o,
  output logic        pbf_o,
  output logic        ready_o,
  // commits of the sequencer
  input  logic        init_i,
  input  logic [6:0]  init_address_i,
  input  logic [15:0] init_ident_i,
  input  logic [3:0]  init_command_i,
  input  logic [7:0]  init_max_input_i,
  input  logic [7:0]  init_max_output_i,
  input  logic [7:0]  init_max_diag_i,
  input  logic [7:0]  init_max_prm_i,
  input  logic [1:0]  init_prm_mode_i,
  input  logic [7:0]  init_max_cfg_i,
  input  logic [1:0]  init_cfg_mode_i,
  input  logic [7:0]  init_cfg_length_i,
  input  logic [7:0]  init_input_length_i,
  input  logic [7:0]  init_output_length_i,
  input  logic        inputs_i,
  input  logic [7:0]  inputs_length_i,
  input  logic        diag_i,
  input  logic [7:0]  diag_type_i,
  input  logic [7:0]  diag_length_i,
  input  logic        verdict_prm_i,
  input  logic        verdict_cfg_i,
  input  logic        verdict_wrong_i,
  input  logic        dpv1_on_i,       // D17
  input  logic        c1_answer_i,     // a block with right CRC
  input  logic        c2_answer_i,
  input  logic [7:0]  answer_length_i, // its data bytes
  // blocks of the user on their way into buffers
  input  logic        stage_inputs_i,
  input  logic        stage_diag_i,
  input  logic        stage_c1_i,
  input  logic        stage_c2_i,
  input  logic        stage_we_i,
  input  logic        stage_msac_we_i,
  input  logic [1:0]  stage_pool_i,
  input  logic [7:0]  stage_index_i,
  input  logic [7:0]  stage_data_i,
  // mail and status for the user
  output logic        initialised_o,
  output logic [7:0]  status_o,        // as in B012
  output logic [15:0] count_o,         // as in B008, B009
  output logic        prm_mail_o,
  output logic        cfg_mail_o,
  output logic        output_mail_o,
  output logic        c1_mail_o,
  output logic        c2_mail_o,
  output logic [7:0]  prm_length_o,
  output logic [7:0]  cfg_length_o,
  output logic [7:0]  cfg_input_length_o,
  output logic [7:0]  cfg_output_length_o,
  output logic [7:0]  output_length_o,
  output logic [7:0]  c1_function_o,
  output logic [7:0]  c2_function_o,
  output logic [7:0]  c1_length_o,
  output logic [7:0]  c2_length_o,
  input  logic        take_prm_i,
  input  logic        take_cfg_i,
  input  logic        take_output_i,
  input  logic        take_c1_i,
  input  logic        take_c2_i,
  input  logic [7:0]  transfer_index_i,
  output logic [7:0]  transfer_data_o
);
  logic rxd, restart, risen, fall, initialised, searching, found;
  logic [3:0] rate;

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
  assign search = init_i || baud_end;

  baud_search u_baud_search (
    `FAULT_CONNECT
    .window_ms_i(search_window_ms_i), .window_bits_i(search_window_bits_i),
    .clk_i(clk_i), .rst_ni(rst_ni), .start_i(search), .telegram_i(any_telegram), .restart_o(restart), .rate_o(rate),
    .searching_o(searching), .found_o(found), .br_o(br_o));

  watchdog u_watchdog (
    `FAULT_CONNECT
    .baud_control_ms_i(baud_control_ms_i),
    .clk_i(clk_i), .rst_ni(rst_ni), .stop_i(init_i), .found_i(found), .commit_dp_i(wd_commit_dp),
    .commit_baud_i(wd_commit_baud), .trigger_i(trigger), .trigger_holder_i(trigger_holder), .accept_dp_i(wd_accept_dp),
    .accept_baud_i(wd_accept_baud), .wait_prm_i(wd_wait_prm), .factor_1_i(wd_factor_1), .factor_2_i(wd_factor_2),
    .base_1ms_i(wd_base_1ms), .baud_end_o(baud_end), .dp_end_o(dp_end), .dp_control_o(dp_control));

  // ---- telegrams and services: those of DPV1 are msac's, all others the DP slave's
  logic from_holder, execute, refuse, fdl_status, srd, sdn, default_sap, builder_busy, send;
  logic data_exch, left, prm_dpv1, msac_replies;
  logic [2:0] answer, answer_source, slave_answer, slave_source, msac_reply;
  logic [7:0] answer_fc, answer_length, slave_fc, slave_length, slave_data, msac_fc, msac_length, msac_data;
  logic [7:0] transfer_slave, transfer_msac, builder_index, builder_data, send_index, send_data, send_length, min_tsdr;
  logic [31:0] answer_diag;
  logic [15:0] ident;
  logic [6:0] address;
  logic [1:0] state;

  fdl u_fdl (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .decide_i(decide), .searching_i(searching), .forget_i(restart), .abort_i(init_i),
    .sd_i(sd), .synced_i(synced), .da_i(da), .sa_i(sa), .fc_i(fc), .dsap_i(dsap), .ssap_i(ssap), .saps_ok_i(saps_ok), .length_i(length), .fcs_i(fcs),
    .address_i(address), .from_holder_i(from_holder), .any_telegram_o(any_telegram), .trigger_o(trigger),
    .trigger_holder_o(trigger_holder), .execute_o(execute), .refuse_o(refuse), .fdl_status_o(fdl_status), .srd_o(srd),
    .sdn_o(sdn), .default_sap_o(default_sap), .answer_i(answer), .answer_fc_i(answer_fc), .answer_source_i(answer_source),
    .answer_length_i(answer_length), .answer_diag_i(answer_diag), .ident_i(ident), .builder_busy_o(builder_busy),
    .builder_index_o(builder_index), .builder_data_i(builder_data), .send_o(send), .send_index_i(send_index),
    .send_data_o(send_data), .send_length_o(send_length));

  dp_slave u_dp_slave (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni),
    .init_i(init_i), .init_address_i(init_address_i), .init_ident_i(init_ident_i), .init_command_i(init_command_i),
    .init_max_input_i(init_max_input_i), .init_max_output_i(init_max_output_i), .init_max_diag_i(init_max_diag_i),
    .init_max_prm_i(init_max_prm_i), .init_prm_mode_i(init_prm_mode_i), .init_max_cfg_i(init_max_cfg_i),
    .init_cfg_mode_i(init_cfg_mode_i), .init_cfg_length_i(init_cfg_length_i), .init_input_length_i(init_input_length_i),
    .init_output_length_i(init_output_length_i), .inputs_i(inputs_i),
    .inputs_length_i(inputs_length_i), .diag_i(diag_i), .diag_type_i(diag_type_i), .diag_length_i(diag_length_i),
    .verdict_prm_i(verdict_prm_i), .verdict_cfg_i(verdict_cfg_i), .verdict_wrong_i(verdict_wrong_i),
    .dpv1_on_i(dpv1_on_i), .stage_inputs_i(stage_inputs_i), .stage_diag_i(stage_diag_i),
    .stage_we_i(stage_we_i), .stage_pool_i(stage_pool_i), .stage_index_i(stage_index_i), .stage_data_i(stage_data_i),
    .dp_end_i(dp_end), .dp_control_i(dp_control), .wd_commit_dp_o(wd_commit_dp), .wd_commit_baud_o(wd_commit_baud),
    .wd_accept_dp_o(wd_accept_dp), .wd_accept_baud_o(wd_accept_baud), .wd_wait_prm_o(wd_wait_prm),
    .wd_factor_1_o(wd_factor_1), .wd_factor_2_o(wd_factor_2), .wd_base_1ms_o(wd_base_1ms),
    .begin_i(tg_begin), .data_valid_i(data_valid), .data_index_i(data_index), .data_i(data), .head_i(head),
    .length_i(length), .sa_i(sa[6:0]), .execute_i(execute), .refuse_i(refuse), .fdl_status_i(fdl_status), .srd_i(srd),
    .sdn_i(sdn), .default_sap_i(default_sap), .dsap_i(dsap), .from_holder_o(from_holder), .data_exch_o(data_exch),
    .left_o(left), .dpv1_o(prm_dpv1), .answer_o(slave_answer),
    .answer_fc_o(slave_fc), .answer_source_o(slave_source), .answer_length_o(slave_length),
    .answer_diag_o(answer_diag), .ident_o(ident), .min_tsdr_o(min_tsdr), .address_o(address),
    .answer_busy_i(builder_busy), .answer_index_i(builder_index), .answer_data_o(slave_data),
    .initialised_o(initialised), .state_o(state), .pbf_o(pbf_o), .count_o(count_o),
    .prm_mail_o(prm_mail_o), .cfg_mail_o(cfg_mail_o), .output_mail_o(output_mail_o), .prm_length_o(prm_length_o),
    .cfg_length_o(cfg_length_o), .cfg_input_length_o(cfg_input_length_o), .cfg_output_length_o(cfg_output_length_o),
    .output_length_o(output_length_o), .take_prm_i(take_prm_i), .take_cfg_i(take_cfg_i), .take_output_i(take_output_i),
    .transfer_index_i(transfer_index_i), .transfer_data_o(transfer_slave));

  msac u_msac (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .init_i(init_i), .left_i(left), .data_exch_i(data_exch), .from_holder_i(from_holder),
    .prm_dpv1_i(prm_dpv1), .dpv1_on_i(dpv1_on_i), .data_valid_i(data_valid), .data_index_i(data_index), .data_i(data),
    .head_i(head), .length_i(length), .sa_i(sa), .ssap_i(ssap), .dsap_i(dsap), .execute_i(execute), .srd_i(srd),
    .sdn_i(sdn), .default_sap_i(default_sap), .replies_o(msac_replies), .reply_o(msac_reply), .reply_fc_o(msac_fc),
    .reply_length_o(msac_length), .reply_index_i(builder_index), .reply_data_o(msac_data), .c1_mail_o(c1_mail_o),
    .c2_mail_o(c2_mail_o), .c1_function_o(c1_function_o), .c2_function_o(c2_function_o), .c1_length_o(c1_length_o),
    .c2_length_o(c2_length_o), .take_c1_i(take_c1_i), .take_c2_i(take_c2_i), .transfer_index_i(transfer_index_i),
    .transfer_data_o(transfer_msac), .stage_c1_i(stage_c1_i), .stage_c2_i(stage_c2_i), .stage_we_i(stage_msac_we_i),
    .stage_index_i(stage_index_i), .stage_data_i(stage_data_i), .c1_answer_i(c1_answer_i), .c2_answer_i(c2_answer_i),
    .answer_data_length_i(answer_length_i));

  assign answer = msac_replies ? msac_reply : slave_answer;
  assign answer_fc = msac_replies ? msac_fc : slave_fc;
  assign answer_source = msac_replies ? SRC_MSAC : slave_source;
  assign answer_length = msac_replies ? msac_length : slave_length;

  // Whose bytes the builder and the sequencer fetch
  logic msac_built_q, msac_transferred_q;
  always_ff @(posedge clk_i) begin
    if (send) msac_built_q <= msac_replies;
    if (take_c1_i || take_c2_i) msac_transferred_q <= 1'b1;
    else if (take_prm_i || take_cfg_i || take_output_i) msac_transferred_q <= 1'b0;
  end
  assign builder_data = msac_built_q ? msac_data : slave_data;
  assign transfer_data_o = msac_transferred_q ? transfer_msac : transfer_slave;

  uart_tx u_uart_tx (
    `FAULT_CONNECT
    .rts_lead_i(rts_lead_i), .rts_trail_i(rts_trail_i),
    .clk_i(clk_i), .rst_ni(rst_ni), .abort_i(init_i), .send_i(send), .rate_i(rate), .min_tsdr_i(min_tsdr),
    .clock_bits_i(clock_bits), .clock_phase_i(clock_phase), .index_o(send_index), .data_i(send_data),
    .length_i(send_length), .risen_o(risen), .fall_o(fall), .pbtxd_o(pbtxd_o), .pbrts_o(pbrts_o));

  assign initialised_o = initialised;
  assign ready_o = initialised;
  assign status_o = {searching ? 4'hF : rate, state, 2'b00};
endmodule
