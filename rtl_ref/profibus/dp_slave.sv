// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The DP slave (section 11; S1 to S33): state, holding master, and what commits and services do to them.
//
// Three things can happen at an edge, in this order: a commit of the user's side, the end of DP_CONTROL, a telegram. Each has its
// group of next values: _q before the edge, _b after commit and end, _d after the telegram. dp_service decides what the telegram is, dp_master
// who holds the slave, dp_address where it is; sap_buffers has the data.
`include "profibus_types.svh"

module dp_slave #(
  parameter logic [7:0] MAX_DATA = MOST_DATA,  // capacities of the user's side (station)
  parameter logic [7:0] MAX_PRM = MOST_PRM,
  parameter logic [7:0] MAX_CFG = MOST_DATA
) (
  `FAULT_PORT
  input  logic        clk_i,
  input  logic        rst_ni,
  // the user's side
  /* verilator lint_off UNUSEDSIGNAL */  // answers to requests of DPV1 are msac's
  input  user_commands_t commands_i,    // answers to requests of DPV1 are msac's
  /* verilator lint_on UNUSEDSIGNAL */
  output dp_mail_t    mail_o,
  output logic [7:0]  mail_data_o,      // of the mail that is being taken
  output dp_status_t  status_o,
  output logic        pbf_o,
  // watchdog
  input  logic        dp_end_i,
  input  logic        dp_control_i,
  output logic        wd_commit_dp_o,
  output logic        wd_commit_baud_o,
  output logic        wd_accept_dp_o,
  output logic        wd_accept_baud_o,
  output logic        wd_wait_prm_o,
  output logic [7:0]  wd_factor_1_o,
  output logic [7:0]  wd_factor_2_o,
  output logic        wd_base_1ms_o,
  // telegram
  input  logic        begin_i,
  input  logic        data_valid_i,
  input  logic [7:0]  data_index_i,
  input  logic [7:0]  data_i,
  input  logic [63:0] head_i,
  input  logic [7:0]  length_i,
  input  logic [6:0]  sa_i,
  input  service_t    service_i,
  input  logic [7:0]  dsap_i,
  output logic        from_holder_o,
  output logic        data_exch_o,      // after the commits
  output logic        left_o,           // DATA_EXCH is left at this edge
  output logic        dpv1_o,           // DPV1_Enable of the Set_Prm in force
  output answer_t     answer_o,
  output logic [31:0] answer_diag_o,    // station status 1 to 3, Master_Add; the first lowest
  output logic [15:0] ident_o,
  output logic [7:0]  min_tsdr_o,
  input  logic        answer_busy_i,
  input  logic [7:0]  answer_index_i,
  output logic [7:0]  answer_data_o
);
  // ---- what the user's side commands
  logic init, verdict_wrong;
  assign init = commands_i.initialise.commit;
  assign verdict_wrong = commands_i.verdict.wrong;

  initialise_t initial_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) initial_q <= 96'd0;
    else if (init) initial_q <= commands_i.initialise;
  end

  // ---- state
  logic [1:0] state_q, state_b, state_d;               // DP_...
  logic held_q, held_b, held_d;                        // by a master
  logic await_prm_q, await_prm_b, await_prm_d;         // the user's verdict
  logic await_cfg_q, await_cfg_b, await_cfg_d;
  logic prm_fault_q, prm_fault_b, prm_fault_d;         // bits of Slave_Diag
  logic unsupported_q, unsupported_b, unsupported_d;
  logic cfg_fault_q, cfg_fault_b, cfg_fault_d;
  logic sync_q, sync_b, sync_d, freeze_q, freeze_b, freeze_d;

  // ---- the telegram's checks, and the user's diagnosis
  decision_t decision;
  prm_t prm;
  /* verilator lint_off UNUSEDSIGNAL */  // WD_On is for the proof of S29
  prm_t in_force;
  /* verilator lint_on UNUSEDSIGNAL */
  logic [6:0] wait_sa;
  logic [7:0] prm_user_length;
  logic prm_unlock, prm_min_only, prm_fault, prm_unsupported, wait_wd_on;

  set_prm #(.MAX_PRM(MAX_PRM)) u_set_prm (
    `FAULT_CONNECT
    .clk_i(clk_i), .head_i(head_i), .length_i(length_i), .initial_i(initial_q), .dpv1_on_i(commands_i.dpv1_on),
    .unlock_o(prm_unlock), .min_tsdr_only_o(prm_min_only), .fault_o(prm_fault), .not_supported_o(prm_unsupported),
    .user_length_o(prm_user_length), .prm_o(prm));

  logic [7:0] peek_index, peek_bus, peek_init, cfg_input_length, cfg_output_length;
  logic [7:0] in_use_length_now, last_cfg_length;
  logic peek_last, cfg_too_long, cfg_same, cfg_right, commit_accept_cfg;

  check_cfg #(.MAX_CFG(MAX_CFG), .MAX_DATA(MAX_DATA)) u_check_cfg (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .begin_i(begin_i), .valid_i(data_valid_i), .index_i(data_index_i), .data_i(data_i),
    .length_i(length_i), .accept_commit_i(commit_accept_cfg), .last_length_i(last_cfg_length),
    .in_use_length_i(in_use_length_now), .initial_i(initial_q),
    .peek_index_o(peek_index), .peek_last_o(peek_last), .peek_bus_i(peek_bus), .peek_init_i(peek_init),
    .too_long_o(cfg_too_long), .same_o(cfg_same), .right_o(cfg_right),
    .input_length_o(cfg_input_length), .output_length_o(cfg_output_length));

  logic diag_store, diag_ext, diag_stat, diag_waiting;
  logic [7:0] diag_length;
  diagnosis u_diagnosis (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .init_i(init), .diagnosis_i(commands_i.diagnosis), .max_length_i(initial_q.max_diag),
    .read_i(decision.diag_read), .store_o(diag_store), .ext_diag_now_o(diag_ext),
    .stat_diag_now_o(diag_stat), .waiting_now_o(diag_waiting), .length_now_o(diag_length));

  // ---- commits and the end of DP_CONTROL
  dp_mail_t mail;
  logic accept_prm_b, refuse_prm_b, refuse_cfg_b, end_leave, prm_counts, cfg_counts;
  assign prm_counts = commands_i.verdict.parameters && await_prm_q && !mail.parameters.waits;
  assign cfg_counts = commands_i.verdict.configuration && await_cfg_q && !mail.configuration.waits;
  assign accept_prm_b = prm_counts && !verdict_wrong;
  assign refuse_prm_b = prm_counts && verdict_wrong;
  assign commit_accept_cfg = cfg_counts && !verdict_wrong;
  assign refuse_cfg_b = cfg_counts && verdict_wrong;
  assign wd_commit_dp_o = accept_prm_b && wait_wd_on;
  assign wd_commit_baud_o = (accept_prm_b && !wait_wd_on) || ((refuse_prm_b || refuse_cfg_b) && dp_control_i);

  // State and holder
  logic releases;  // a refusal or the end
  assign releases = refuse_prm_b || refuse_cfg_b || dp_end_i;
  always_comb begin
    state_b = state_q;
    if (accept_prm_b) state_b = DP_WAIT_CFG;
    if (commit_accept_cfg) state_b = DP_DATA_EXCH;
    end_leave = dp_end_i && state_b == DP_DATA_EXCH;
    if (releases) state_b = DP_WAIT_PRM;
  end
  assign held_b = (held_q || accept_prm_b) && !releases;
  assign await_prm_b = await_prm_q && !prm_counts && !releases;
  assign await_cfg_b = await_cfg_q && !cfg_counts && !releases;
  assign sync_b = sync_q && !releases;
  assign freeze_b = freeze_q && !releases;

  // Bits of Slave_Diag
  assign prm_fault_b = (prm_fault_q && !accept_prm_b) || refuse_prm_b;
  assign unsupported_b = unsupported_q && !accept_prm_b;
  assign cfg_fault_b = (cfg_fault_q && !commit_accept_cfg) || refuse_cfg_b;

  // ---- the telegram
  logic in_data_exch, urgent, from_holder, other_holder, delivery_address, locked, good_prm, accept_prm;
  logic [6:0] holder_b;
  dp_master u_master (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .init_i(init), .sa_i(sa_i), .accept_waiting_i(accept_prm_b), .waiting_sa_i(wait_sa),
    .held_i(held_b), .accept_i(accept_prm), .holder_o(holder_b), .from_holder_o(from_holder), .other_holder_o(other_holder));
  assign from_holder_o = from_holder;
  logic [7:0] input_length, input_length_now, output_length_now;
  assign in_data_exch = state_b == DP_DATA_EXCH;
  assign urgent = diag_waiting || (diag_stat && !`FAULT(123));

  dp_service u_service (
    `FAULT_CONNECT
    .service_i(service_i), .dsap_i(dsap_i), .head_i(head_i[23:0]), .length_i(length_i), .state_i(state_b), .sync_i(sync_b),
    .from_holder_i(from_holder), .other_holder_i(other_holder), .delivery_address_i(delivery_address), .locked_i(locked),
    .fail_safe_i(in_force.fail_safe), .urgent_i(urgent), .initial_i(initial_q), .prm_fault_i(prm_fault),
    .prm_unsupported_i(prm_unsupported), .prm_unlock_i(prm_unlock), .prm_min_only_i(prm_min_only),
    .cfg_too_long_i(cfg_too_long), .cfg_same_i(cfg_same), .cfg_right_i(cfg_right), .input_length_i(input_length_now),
    .output_length_i(output_length_now), .cfg_length_i(in_use_length_now), .diag_length_i(diag_length),
    .group_i(in_force.group), .sync_req_i(in_force.sync_req), .freeze_req_i(in_force.freeze_req), .answer_o(answer_o),
    .decision_o(decision));

  logic good_cfg, accept_cfg, enter_wait_prm, leave, new_prm_fault, new_cfg_fault, new_unsupported;
  logic gc_sync, gc_unsync, gc_freeze, gc_unfreeze;
  assign good_prm = decision.good_prm;
  assign accept_prm = decision.accept_prm;
  assign good_cfg = decision.good_cfg;
  assign accept_cfg = decision.accept_cfg;
  assign enter_wait_prm = decision.enter_wait_prm;
  assign new_prm_fault = decision.prm_fault;
  assign new_cfg_fault = decision.cfg_fault;
  assign new_unsupported = decision.not_supported;
  assign gc_sync = decision.sync;
  assign gc_unsync = decision.unsync;
  assign gc_freeze = decision.freeze;
  assign gc_unfreeze = decision.unfreeze;
`ifdef SINGLE_FAULTS
  logic by_data_exchange;
  assign by_data_exchange = service_i.default_sap;
`endif

  // State and holder (S15, S18). In DATA_EXCH a right Chk_Cfg is mail and nothing else (S16)
  logic good_cfg_waits, keeps_held;
  assign good_cfg_waits = good_cfg && !in_data_exch;
  assign leave = in_data_exch && (good_prm || enter_wait_prm);
  always_comb begin
    state_d = state_b;
    if (good_prm) state_d = accept_prm ? DP_WAIT_CFG : DP_WAIT_PRM;
    if (good_cfg_waits && accept_cfg) state_d = DP_DATA_EXCH;
    if (enter_wait_prm) state_d = DP_WAIT_PRM;
  end
  assign keeps_held =
`ifdef SINGLE_FAULTS
      (`FAULT(185) && by_data_exchange) ||
`endif
      !enter_wait_prm;
  assign held_d = keeps_held && (held_b || (good_prm && accept_prm));

  // Verdicts that are awaited
  always_comb begin
    await_prm_d = await_prm_b;
    await_cfg_d = await_cfg_b;
    if (good_prm) begin
      await_prm_d = !accept_prm;
      await_cfg_d = 1'b0;
    end
    if (good_cfg_waits) await_cfg_d = !accept_cfg;
    if (enter_wait_prm) begin
      await_prm_d = 1'b0;
      await_cfg_d = 1'b0;
    end
  end

  // Bits of Slave_Diag
  logic clears_prm_fault, clears_cfg_fault;
  assign clears_prm_fault = good_prm && accept_prm;
  assign clears_cfg_fault = good_cfg_waits && accept_cfg;
  assign prm_fault_d = (prm_fault_b || new_prm_fault) && !clears_prm_fault;
  assign unsupported_d = (unsupported_b || new_unsupported) && !clears_prm_fault;
  assign cfg_fault_d = (cfg_fault_b || new_cfg_fault) && !clears_cfg_fault;

  // Sync and Freeze (S24, S27)
  logic syncs;
  assign syncs =
`ifdef SINGLE_FAULTS
      !(`FAULT(175) && gc_freeze) &&
`endif
      gc_sync;
  assign sync_d = (sync_b || syncs) && !gc_unsync && !leave;
  assign freeze_d = (freeze_b || gc_freeze) && !gc_unfreeze && !leave;

  // Slave_Diag's standard bytes (section 11)
  logic watchdog_on;
  assign watchdog_on = wd_commit_dp_o || (dp_control_i && !dp_end_i && !wd_commit_baud_o);
  assign answer_diag_o = {held_b ? {1'b0, holder_b} : 8'hFF, 8'h00,
                          2'b00, sync_b, freeze_b, watchdog_on, 1'b1, diag_stat,
                          state_b == DP_WAIT_PRM && !await_prm_b,
                          1'b0, prm_fault_b, 1'b0, unsupported_b, diag_ext, cfg_fault_b, !in_data_exch, 1'b0};

  dp_parameters u_parameters (
`ifdef SINGLE_FAULTS
    `FAULT_CONNECT
`endif
    .clk_i(clk_i), .rst_ni(rst_ni), .init_i(init), .accept_waiting_i(accept_prm_b), .prm_i(prm), .sa_i(sa_i), .waits_i(good_prm),
    .accept_i(accept_prm), .min_tsdr_only_i(decision.min_tsdr_only), .waiting_wd_on_o(wait_wd_on), .waiting_sa_o(wait_sa),
    .in_force_o(in_force));

  assign wd_accept_dp_o = accept_prm && prm.wd_on;
  assign wd_accept_baud_o = accept_prm && !prm.wd_on;
  assign wd_wait_prm_o = enter_wait_prm;
  assign wd_factor_1_o = in_force.wd_factor_1;
  assign wd_factor_2_o = in_force.wd_factor_2;
  assign wd_base_1ms_o = in_force.wd_base_1ms;

  // ---- registers: the state, which an initialisation begins
  logic initialised_q, pbf_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= DP_OFFLINE;
      initialised_q <= 1'b0;
      pbf_q <= 1'b1;
    end else if (init) begin
      state_q <= DP_WAIT_PRM;
      initialised_q <= 1'b1;
      pbf_q <= 1'b1;
    end else begin
      state_q <= state_d;
      pbf_q <= state_d != DP_DATA_EXCH;
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {held_q, await_prm_q, await_cfg_q, sync_q, freeze_q} <= 5'd0;
      {prm_fault_q, unsupported_q, cfg_fault_q} <= 3'd0;
    end else if (init) begin
      {held_q, await_prm_q, await_cfg_q, sync_q, freeze_q} <= 5'd0;
      {prm_fault_q, unsupported_q, cfg_fault_q} <= 3'd0;
    end else begin
      held_q <= held_d;
      await_prm_q <= await_prm_d;
      await_cfg_q <= await_cfg_d;
      sync_q <= sync_d;
      freeze_q <= freeze_d;
      prm_fault_q <= prm_fault_d;
      unsupported_q <= unsupported_d;
      cfg_fault_q <= cfg_fault_d;
    end
  end

  // ---- how often DATA_EXCH was left, for whatever reason (S18)
  logic left;
  logic [15:0] count_q;
  assign left = (leave && !`FAULT(37)) || end_leave || (init && state_q == DP_DATA_EXCH);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) count_q <= 16'd0;
    else if (left) count_q <= count_q + 16'd1;
  end

  // ---- own address
  logic [6:0] address;
  dp_address u_address (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .init_i(init), .init_address_i(commands_i.initialise.address), .set_i(decision.set_address),
    .new_address_i(head_i[6:0]), .no_add_chg_i(head_i[31:24]), .address_o(address), .locked_o(locked), .delivery_o(delivery_address));

  // Global_Control for the user's side
  logic global_control_q;
  logic [7:0] control_command_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) global_control_q <= 1'b0;
    else global_control_q <= decision.global_control;
  end
  always_ff @(posedge clk_i) if (decision.global_control) control_command_q <= head_i[7:0];

  logic commit_inputs;
  assign commit_inputs = commands_i.inputs.commit && commands_i.inputs.length == input_length;
  sap_buffers u_buffers (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni),
    .begin_i(begin_i), .data_valid_i(data_valid_i), .data_index_i(data_index_i), .data_i(data_i), .stage_i(commands_i.stage),
    .init_i(commands_i.initialise), .init_leave_i(state_q == DP_DATA_EXCH), .commit_inputs_i(commit_inputs),
    .commit_diag_i(diag_store), .commit_accept_cfg_i(commit_accept_cfg), .end_leave_i(end_leave), .hold_outputs_i(sync_b),
    .hold_inputs_i(freeze_q), .leave_i(leave), .decision_i(decision), .mail_prm_length_i(prm_user_length),
    .cfg_length_i(length_i), .cfg_input_length_i(cfg_input_length), .cfg_output_length_i(cfg_output_length), .input_length_o(input_length),
    .input_length_now_o(input_length_now), .output_length_now_o(output_length_now), .cfg_length_now_o(in_use_length_now),
    .last_cfg_length_o(last_cfg_length), .peek_index_i(peek_index), .peek_last_i(peek_last), .peek_bus_o(peek_bus),
    .peek_init_o(peek_init), .answer_i(service_i.execute), .answer_source_i(answer_o.source), .answer_busy_i(answer_busy_i),
    .answer_index_i(answer_index_i), .answer_data_o(answer_data_o), .mail_o(mail), .take_i(commands_i.take),
    .mail_data_o(mail_data_o));

  assign data_exch_o = in_data_exch;
  assign left_o = leave || end_leave;
  assign dpv1_o = in_force.dpv1;
  assign ident_o = initial_q.ident;
  assign min_tsdr_o = in_force.min_tsdr;
  assign mail_o = mail;
  assign pbf_o = pbf_q;
  assign status_o.initialised = initialised_q;
  assign status_o.state = state_q;
  assign status_o.left = count_q;
  assign status_o.address = address;
  assign status_o.global_control = global_control_q;
  assign status_o.global_control_command = control_command_q;
endmodule
