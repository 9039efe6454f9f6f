// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The DP slave (section 11; S1 to S33): state, holding master, and what commits and services do to them.
//
// Three things can happen at an edge, in this order: a commit of the user's side, the end of DP_CONTROL, a telegram. Each has its
// group of next values: _q before the edge, _b after commit and end, _d after the telegram.
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
  /* verilator lint_off UNUSEDSIGNAL */
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
  localparam logic [6:0] NO_MASTER = 7'h7F;
  localparam logic [6:0] DELIVERY_ADDRESS = 7'd126;

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
  logic [1:0] state_q, state_b, state_d;
  logic held_q, held_b, held_d;
  logic [6:0] holder_q, holder_d, address_q, address_d;
  logic locked_q, locked_d;  // No_Add_Chg
  logic await_prm_q, await_prm_b, await_prm_d, await_cfg_q, await_cfg_b, await_cfg_d;
  logic prm_fault_q, prm_fault_b, prm_fault_d, unsupported_q, unsupported_b, unsupported_d;
  logic cfg_fault_q, cfg_fault_b, cfg_fault_d;
  logic sync_q, sync_b, sync_d, freeze_q, freeze_b, freeze_d;
  logic initialised_q, pbf_q;
  logic [15:0] count_q, count_d;

  // ---- the telegram's checks, and the user's diagnosis
  decision_t decision;
  prm_t prm;
  /* verilator lint_off UNUSEDSIGNAL */
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

  always_comb begin
    state_b = state_q;
    held_b = held_q;
    await_prm_b = await_prm_q && !prm_counts;
    await_cfg_b = await_cfg_q && !cfg_counts;
    prm_fault_b = prm_fault_q;
    unsupported_b = unsupported_q;
    cfg_fault_b = cfg_fault_q;
    sync_b = sync_q;
    freeze_b = freeze_q;
    if (accept_prm_b) begin
      state_b = DP_WAIT_CFG;
      held_b = 1'b1;
      prm_fault_b = 1'b0;
      unsupported_b = 1'b0;
    end
    if (commit_accept_cfg) begin
      state_b = DP_DATA_EXCH;
      cfg_fault_b = 1'b0;
    end
    if (refuse_prm_b) prm_fault_b = 1'b1;
    if (refuse_cfg_b) cfg_fault_b = 1'b1;
    end_leave = dp_end_i && state_b == DP_DATA_EXCH;
    if (refuse_prm_b || refuse_cfg_b || dp_end_i) begin
      state_b = DP_WAIT_PRM;
      held_b = 1'b0;
      await_prm_b = 1'b0;
      await_cfg_b = 1'b0;
      sync_b = 1'b0;
      freeze_b = 1'b0;
    end
  end

  // Is the telegram's SA the holder after the commits? Both comparisons stand still long before.
  logic sa_is_holder_q, sa_is_waiting_q, from_holder, other_holder;
  logic delivery_address_q;  // S33
  always_ff @(posedge clk_i) begin
    sa_is_holder_q <= sa_i == holder_q;
    sa_is_waiting_q <= sa_i == wait_sa;
    delivery_address_q <= address_q == DELIVERY_ADDRESS && !`FAULT(125);
  end
  assign from_holder = held_b && (accept_prm_b ? sa_is_waiting_q : sa_is_holder_q);
  assign other_holder = held_b && !(accept_prm_b ? sa_is_waiting_q : sa_is_holder_q) && !`FAULT(34);
  assign from_holder_o = from_holder;

  // ---- the telegram
  logic in_data_exch, urgent;
  logic [7:0] input_length, input_length_now, output_length_now;
  assign in_data_exch = state_b == DP_DATA_EXCH;
  assign urgent = diag_waiting || (diag_stat && !`FAULT(123));

  dp_service u_service (
    `FAULT_CONNECT
    .service_i(service_i), .dsap_i(dsap_i), .head_i(head_i[23:0]), .length_i(length_i), .state_i(state_b), .sync_i(sync_b),
    .from_holder_i(from_holder), .other_holder_i(other_holder), .delivery_address_i(delivery_address_q), .locked_i(locked_q),
    .fail_safe_i(in_force.fail_safe), .urgent_i(urgent), .initial_i(initial_q), .prm_fault_i(prm_fault),
    .prm_unsupported_i(prm_unsupported), .prm_unlock_i(prm_unlock), .prm_min_only_i(prm_min_only),
    .cfg_too_long_i(cfg_too_long), .cfg_same_i(cfg_same), .cfg_right_i(cfg_right), .input_length_i(input_length_now),
    .output_length_i(output_length_now), .cfg_length_i(in_use_length_now), .diag_length_i(diag_length),
    .group_i(in_force.group), .sync_req_i(in_force.sync_req), .freeze_req_i(in_force.freeze_req), .answer_o(answer_o),
    .decision_o(decision));

  logic good_prm, accept_prm, good_cfg, accept_cfg, enter_wait_prm, leave, new_prm_fault, new_cfg_fault, new_unsupported;
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

  always_comb begin
    leave = 1'b0;
    state_d = state_b;
    held_d = held_b;
    await_prm_d = await_prm_b;
    await_cfg_d = await_cfg_b;
    prm_fault_d = prm_fault_b || new_prm_fault;
    unsupported_d = unsupported_b || new_unsupported;
    cfg_fault_d = cfg_fault_b || new_cfg_fault;
    sync_d = sync_b;
    freeze_d = freeze_b;
    if (gc_unsync) sync_d = 1'b0;
    else if (gc_sync) sync_d = 1'b1;
    if (gc_unfreeze) freeze_d = 1'b0;
    else if (gc_freeze) freeze_d = 1'b1;
`ifdef SINGLE_FAULTS
    if (`FAULT(175) && gc_sync && gc_freeze) sync_d = sync_b;
`endif

    // S15, S18
    if (good_prm) begin
      leave = in_data_exch;
      state_d = accept_prm ? DP_WAIT_CFG : DP_WAIT_PRM;
      await_prm_d = !accept_prm;
      await_cfg_d = 1'b0;
      if (accept_prm) begin
        held_d = 1'b1;
        prm_fault_d = 1'b0;
        unsupported_d = 1'b0;
      end
    end
    if (good_cfg && !in_data_exch) begin  // in DATA_EXCH it is mail and nothing else (S16)
      await_cfg_d = !accept_cfg;
      if (accept_cfg) begin
        state_d = DP_DATA_EXCH;
        cfg_fault_d = 1'b0;
      end
    end
    if (enter_wait_prm) begin
      leave = in_data_exch;
      state_d = DP_WAIT_PRM;
      held_d = 1'b0;
      await_prm_d = 1'b0;
      await_cfg_d = 1'b0;
    end
    if (leave) begin
      sync_d = 1'b0;
      freeze_d = 1'b0;
    end
`ifdef SINGLE_FAULTS
    if (`FAULT(185) && enter_wait_prm && by_data_exchange) held_d = held_b;
`endif
  end

  // Slave_Diag's standard bytes (section 11)
  logic [6:0] holder_b;
  logic watchdog_on;
  assign holder_b = accept_prm_b ? wait_sa : holder_q;
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

  // S18: leaving DATA_EXCH is counted, for whatever reason
  logic left;
  assign left = (leave && !`FAULT(37)) || end_leave || (init && state_q == DP_DATA_EXCH);
  assign count_d = left ? count_q + 16'd1 : count_q;

  logic set_address;
  logic [6:0] new_address, init_address;
  logic [7:0] ssa_lock;
  assign set_address = decision.set_address;
  assign new_address = head_i[6:0];
  assign ssa_lock = head_i[31:24];
  assign init_address = commands_i.initialise.address;
`ifdef SINGLE_FAULTS
  logic lock_low;
  assign lock_low = head_i[24];
`endif
  always_comb begin
    holder_d = holder_b;
    address_d = address_q;
    locked_d = locked_q;
    if (accept_prm) holder_d = sa_i;
    if (set_address) begin
      address_d = new_address;
      locked_d = ssa_lock != 8'h00;
`ifdef SINGLE_FAULTS
      if (`FAULT(186)) locked_d = lock_low;
`endif
    end
    if (init) begin
      holder_d = NO_MASTER;
      address_d = init_address;
      locked_d = 1'b0;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= DP_OFFLINE;
      {held_q, locked_q, await_prm_q, await_cfg_q, prm_fault_q, unsupported_q, cfg_fault_q} <= 7'd0;
      {sync_q, freeze_q, initialised_q} <= 3'd0;
      pbf_q <= 1'b1;
      holder_q <= NO_MASTER;
      address_q <= NO_MASTER;
      count_q <= 16'd0;
    end else begin
      holder_q <= holder_d;
      address_q <= address_d;
      locked_q <= locked_d;
      count_q <= count_d;
      if (init) begin
        state_q <= DP_WAIT_PRM;
        {held_q, await_prm_q, await_cfg_q, prm_fault_q, unsupported_q, cfg_fault_q, sync_q, freeze_q} <= 8'd0;
        initialised_q <= 1'b1;
        pbf_q <= 1'b1;
      end else begin
        state_q <= state_d;
        held_q <= held_d;
        await_prm_q <= await_prm_d;
        await_cfg_q <= await_cfg_d;
        prm_fault_q <= prm_fault_d;
        unsupported_q <= unsupported_d;
        cfg_fault_q <= cfg_fault_d;
        sync_q <= sync_d;
        freeze_q <= freeze_d;
        pbf_q <= state_d != DP_DATA_EXCH;
      end
    end
  end

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
  assign status_o.address = address_q;
  assign status_o.global_control = global_control_q;
  assign status_o.global_control_command = control_command_q;
endmodule
