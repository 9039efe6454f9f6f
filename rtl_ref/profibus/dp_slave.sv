// The DP slave (section 11; S1 to S33): state, holding master, services.
//
// Three things can happen at an edge, in this order: a commit of the sequencer, the end of DP_CONTROL, a telegram. Each has its
// group of next values: _q before the edge, _b behind commit and end, _d behind the telegram.
`include "dsdpv1_types.svh"

module dp_slave (
  `FAULT_PORT
  input  logic        clk_i,
  input  logic        rst_ni,
  // commits
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
  input  logic        inputs_i,         // a block with right CRC
  input  logic [7:0]  inputs_length_i,
  input  logic        diag_i,           // a block with right CRC
  input  logic [7:0]  diag_type_i,
  input  logic [7:0]  diag_length_i,
  input  logic        verdict_prm_i,
  input  logic        verdict_cfg_i,
  input  logic        verdict_wrong_i,
  input  logic        dpv1_on_i,        // D17
  input  logic        stage_inputs_i,
  input  logic        stage_diag_i,
  input  logic        stage_we_i,
  input  logic [1:0]  stage_pool_i,
  input  logic [7:0]  stage_index_i,
  input  logic [7:0]  stage_data_i,
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
  input  logic        execute_i,        // the service is executed at this edge
  input  logic        refuse_i,         // it is one that is always refused
  input  logic        fdl_status_i,
  input  logic        srd_i,
  input  logic        sdn_i,
  input  logic        default_sap_i,
  input  logic [7:0]  dsap_i,
  output logic        from_holder_o,
  output logic        data_exch_o,      // behind the commits
  output logic        left_o,           // DATA_EXCH is left at this edge
  output logic        dpv1_o,           // DPV1_Enable of the Set_Prm in force
  output logic [2:0]  answer_o,         // ANS_...
  output logic [7:0]  answer_fc_o,
  output logic [2:0]  answer_source_o,
  output logic [7:0]  answer_length_o,
  output logic [31:0] answer_diag_o,    // station status 1 to 3, Master_Add; the first lowest
  output logic [15:0] ident_o,
  output logic [7:0]  min_tsdr_o,
  output logic [6:0]  address_o,
  input  logic        answer_busy_i,
  input  logic [7:0]  answer_index_i,
  output logic [7:0]  answer_data_o,
  // the user's side
  output logic        initialised_o,
  output logic [1:0]  state_o,
  output logic        pbf_o,
  output logic [15:0] count_o,
  output logic        prm_mail_o,
  output logic        cfg_mail_o,
  output logic        output_mail_o,
  output logic [7:0]  prm_length_o,
  output logic [7:0]  cfg_length_o,
  output logic [7:0]  cfg_input_length_o,
  output logic [7:0]  cfg_output_length_o,
  output logic [7:0]  output_length_o,
  input  logic        take_prm_i,
  input  logic        take_cfg_i,
  input  logic        take_output_i,
  input  logic [7:0]  transfer_index_i,
  output logic [7:0]  transfer_data_o
);
  localparam logic [6:0] NO_MASTER = 7'h7F;
  localparam logic [6:0] DELIVERY_ADDRESS = 7'd126;

  // ---- initialisation
  logic [15:0] ident_q;
  logic [3:0] command_q;
  logic [7:0] max_input_q, max_output_q, max_diag_q, max_prm_q, max_cfg_q, init_cfg_length_q;
  logic [1:0] prm_mode_q, cfg_mode_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      ident_q <= 16'd0;
      command_q <= 4'd0;
      {max_input_q, max_output_q, max_diag_q, max_prm_q, max_cfg_q, init_cfg_length_q} <= 48'd0;
      {prm_mode_q, cfg_mode_q} <= 4'd0;
    end else if (init_i) begin
      ident_q <= init_ident_i;
      command_q <= init_command_i;
      max_input_q <= init_max_input_i;
      max_output_q <= init_max_output_i;
      max_diag_q <= init_max_diag_i;
      max_prm_q <= init_max_prm_i;
      prm_mode_q <= init_prm_mode_i;
      max_cfg_q <= init_max_cfg_i;
      cfg_mode_q <= init_cfg_mode_i;
      init_cfg_length_q <= init_cfg_length_i;
    end
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

  // Parameters: those accepted, those that wait for the verdict, those of the telegram
  logic [7:0] min_tsdr_q, group_q, wd_factor_1_q, wd_factor_2_q;
  logic sync_req_q, freeze_req_q, fail_safe_q, wd_base_1ms_q, dpv1_q;
  logic [6:0] wait_sa_q;
  logic [7:0] wait_min_tsdr_q, wait_group_q, wait_factor_1_q, wait_factor_2_q;
  logic wait_sync_req_q, wait_freeze_req_q, wait_fail_safe_q, wait_wd_on_q, wait_base_1ms_q, wait_dpv1_q;
  logic [7:0] prm_min_tsdr, prm_group, prm_factor_1, prm_factor_2, prm_user_length;
  logic prm_sync_req, prm_freeze_req, prm_fail_safe, prm_wd_on, prm_base_1ms, prm_dpv1;
  logic prm_unlock, prm_min_only, prm_fault, prm_unsupported;

  logic [7:0] command_byte, group_select;
  assign command_byte = head_i[7:0];
  assign group_select = head_i[15:8];

  set_prm u_set_prm (
    `FAULT_CONNECT
    .clk_i(clk_i), .head_i(head_i), .length_i(length_i), .ident_i(ident_q), .command_i(command_q[3:1]),
    .max_length_i(max_prm_q), .mode_i(prm_mode_q), .dpv1_on_i(dpv1_on_i),
    .unlock_o(prm_unlock), .min_tsdr_only_o(prm_min_only), .fault_o(prm_fault), .not_supported_o(prm_unsupported),
    .user_length_o(prm_user_length), .wd_on_o(prm_wd_on), .wd_factor_1_o(prm_factor_1), .wd_factor_2_o(prm_factor_2),
    .wd_base_1ms_o(prm_base_1ms), .min_tsdr_o(prm_min_tsdr), .group_o(prm_group), .sync_req_o(prm_sync_req),
    .freeze_req_o(prm_freeze_req), .fail_safe_o(prm_fail_safe), .dpv1_o(prm_dpv1));

  logic [7:0] peek_index, peek_bus, peek_init, cfg_input_length, cfg_output_length;
  logic [7:0] in_use_length_now, last_cfg_length;
  logic peek_last, cfg_too_long, cfg_same, cfg_right, commit_accept_cfg;

  check_cfg u_check_cfg (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .begin_i(begin_i), .valid_i(data_valid_i), .index_i(data_index_i), .data_i(data_i),
    .length_i(length_i), .accept_commit_i(commit_accept_cfg), .last_length_i(last_cfg_length),
    .in_use_length_i(in_use_length_now), .init_length_i(init_cfg_length_q), .max_length_i(max_cfg_q),
    .max_input_i(max_input_q), .max_output_i(max_output_q), .mode_i(cfg_mode_q),
    .peek_index_o(peek_index), .peek_last_o(peek_last), .peek_bus_i(peek_bus), .peek_init_i(peek_init),
    .too_long_o(cfg_too_long), .same_o(cfg_same), .right_o(cfg_right),
    .input_length_o(cfg_input_length), .output_length_o(cfg_output_length));

  logic gc_clear, gc_unsync, gc_sync, gc_unfreeze, gc_freeze, gc_unsupported;
  global_control u_global_control (
    `FAULT_CONNECT
    .command_i(command_byte), .group_select_i(group_select), .length_i(length_i), .group_ident_i(group_q),
    .sync_req_i(sync_req_q), .freeze_req_i(freeze_req_q), .can_sync_i(command_q[2]), .can_freeze_i(command_q[1]), .clear_o(gc_clear), .unsync_o(gc_unsync), .sync_o(gc_sync),
    .unfreeze_o(gc_unfreeze), .freeze_o(gc_freeze), .unsupported_o(gc_unsupported));

  logic diag_store, diag_read, diag_ext, diag_stat, diag_waiting;
  logic [7:0] diag_length;
  diagnosis u_diagnosis (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .init_i(init_i), .commit_i(diag_i), .type_i(diag_type_i), .length_i(diag_length_i),
    .max_length_i(max_diag_q), .read_i(diag_read), .store_o(diag_store), .ext_diag_now_o(diag_ext),
    .stat_diag_now_o(diag_stat), .waiting_now_o(diag_waiting), .length_now_o(diag_length));

  // ---- commits and the end of DP_CONTROL
  logic accept_prm_b, refuse_prm_b, refuse_cfg_b, end_leave, prm_counts, cfg_counts;
  assign prm_counts = verdict_prm_i && await_prm_q && !prm_mail_o;
  assign cfg_counts = verdict_cfg_i && await_cfg_q && !cfg_mail_o;
  assign accept_prm_b = prm_counts && !verdict_wrong_i;
  assign refuse_prm_b = prm_counts && verdict_wrong_i;
  assign commit_accept_cfg = cfg_counts && !verdict_wrong_i;
  assign refuse_cfg_b = cfg_counts && verdict_wrong_i;
  assign wd_commit_dp_o = accept_prm_b && wait_wd_on_q;
  assign wd_commit_baud_o = (accept_prm_b && !wait_wd_on_q) || ((refuse_prm_b || refuse_cfg_b) && dp_control_i);

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

  // Is the telegram's SA the holder behind the commits? Both comparisons stand still long before.
  logic sa_is_holder_q, sa_is_waiting_q, from_holder, other_holder;
  logic delivery_address_q;  // S33
  always_ff @(posedge clk_i) begin
    sa_is_holder_q <= sa_i == holder_q;
    sa_is_waiting_q <= sa_i == wait_sa_q;
    delivery_address_q <= address_q == DELIVERY_ADDRESS && !`FAULT(125);
  end
  assign from_holder = held_b && (accept_prm_b ? sa_is_waiting_q : sa_is_holder_q);
  assign other_holder = held_b && !(accept_prm_b ? sa_is_waiting_q : sa_is_holder_q) && !`FAULT(34);
  assign from_holder_o = from_holder;

  // ---- the telegram
  logic [2:0] answer;
  logic [7:0] fc;
  logic [2:0] source;
  logic [7:0] input_length, input_length_now, output_length_now;
  logic good_prm, accept_prm, good_cfg, accept_cfg, leave, enter_wait_prm, store, clear, copy_outputs, copy_inputs, set_address;
  logic min_tsdr_only, in_data_exch, execute_srd;
  logic [7:0] ssa_lock;
  logic [15:0] ssa_ident;
  logic urgent;
  logic [7:0] ssa_address;
  logic [6:0] new_address;
  logic user_judges_prm, user_judges_cfg, fits_outputs, is_empty, has_data, supports_address;
  assign ssa_address = head_i[7:0];
  assign new_address = head_i[6:0];
  assign ssa_ident = {head_i[15:8], head_i[23:16]};
  assign ssa_lock = head_i[31:24];
  assign in_data_exch = state_b == DP_DATA_EXCH;
  assign execute_srd = execute_i && srd_i;
  assign urgent = (diag_waiting || (diag_stat && !`FAULT(123))) && default_sap_i;  // D9: only data exchange says so
  assign user_judges_prm = prm_mode_q == 2'd2;
  assign user_judges_cfg = cfg_mode_q == 2'd2;
  assign fits_outputs = length_i == output_length_now;
  assign is_empty = length_i == 8'd0;
  assign has_data = !is_empty && !`FAULT(124);  // S13
  assign supports_address = command_q[0];

  always_comb begin
    answer = ANS_NONE;
    fc = FC_OK;
    source = SRC_NONE;
    good_prm = 1'b0;
    accept_prm = 1'b0;
    good_cfg = 1'b0;
    accept_cfg = 1'b0;
    store = 1'b0;
    clear = 1'b0;
    copy_outputs = 1'b0;
    copy_inputs = 1'b0;
    set_address = 1'b0;
    min_tsdr_only = 1'b0;
    enter_wait_prm = 1'b0;
    leave = 1'b0;
    diag_read = 1'b0;
    state_d = state_b;
    held_d = held_b;
    await_prm_d = await_prm_b;
    await_cfg_d = await_cfg_b;
    prm_fault_d = prm_fault_b;
    unsupported_d = unsupported_b;
    cfg_fault_d = cfg_fault_b;
    sync_d = sync_b;
    freeze_d = freeze_b;

    if (execute_i && fdl_status_i) answer = ANS_SD1;
    if (execute_i && refuse_i) begin
      answer = ANS_SD1;
      fc = FC_RS;
    end

    if (execute_srd && default_sap_i) begin
      // Data exchange (6.2.5, S19)
      answer = ANS_SD1;
      fc = FC_RS;
      if (in_data_exch && from_holder) begin
        if (fits_outputs) begin
          store = 1'b1;
          source = SRC_INPUTS;
        end else if (fail_safe_q && is_empty) begin
          clear = 1'b1;
          source = SRC_INPUTS;
        end else begin
          fc = FC_RR;
          cfg_fault_d = 1'b1;
          enter_wait_prm = 1'b1;
        end
      end
    end else if (execute_srd) begin
      answer = ANS_SD1;
      fc = FC_RS;
      case (dsap_i)
        8'd55: begin  // Set_Slave_Address (6.2.1, S5, S25)
          if (state_b == DP_WAIT_PRM && supports_address && (!locked_q || `FAULT(35))) begin
            if (length_i > 8'd4) fc = FC_RR;
            else begin
              answer = ANS_SC;
              set_address = length_i == 8'd4 && ssa_ident == ident_q && ssa_address <= 8'd125;
            end
          end
        end
        8'd56: begin  // Read_Inputs
          if (in_data_exch) begin
            if (has_data) fc = FC_RR;
            else source = SRC_INPUTS;
          end
        end
        8'd57: begin  // Read_Outputs
          if (has_data) fc = FC_RR;
          else source = SRC_OUTPUTS;
        end
        8'd59: begin  // Get_Cfg
          if (has_data) fc = FC_RR;
          else source = in_data_exch || `FAULT(36) ? SRC_CFG : SRC_INIT_CFG;
        end
        8'd60: begin  // Slave_Diag (S23)
          if (has_data) fc = FC_RR;
          else begin
            source = SRC_DIAG;
            diag_read = from_holder;
          end
        end
        8'd61: begin  // Set_Prm
          if (!other_holder && !delivery_address_q) begin
            answer = ANS_SC;
            if (prm_fault) begin
              prm_fault_d = 1'b1;
              if (prm_unsupported) unsupported_d = 1'b1;
              enter_wait_prm = 1'b1;
            end else if (prm_unlock) begin
              enter_wait_prm = 1'b1;
            end else if (prm_min_only) begin
              min_tsdr_only = 1'b1;
            end else begin
              good_prm = 1'b1;
              accept_prm = !user_judges_prm;
            end
          end
        end
        8'd62: begin  // Check_Cfg
          if ((state_b == DP_WAIT_CFG || in_data_exch) && from_holder) begin
            if (cfg_too_long) fc = FC_RR;
            else begin
              answer = ANS_SC;
              if (in_data_exch ? cfg_same : cfg_right) begin
                good_cfg = 1'b1;
                accept_cfg = !in_data_exch && !user_judges_cfg;
              end else begin
                cfg_fault_d = 1'b1;
                enter_wait_prm = 1'b1;
              end
            end
          end
        end
        default: ;
      endcase
    end else if (execute_i && sdn_i && !default_sap_i && dsap_i == 8'd58 && in_data_exch && from_holder) begin
      // Global_Control (6.2.6, S24)
      clear = gc_clear;
      copy_outputs = gc_sync || (gc_unsync && sync_b);
      copy_inputs = gc_freeze || gc_unfreeze;
      if (gc_unsync) sync_d = 1'b0;
      else if (gc_sync) sync_d = 1'b1;
      if (gc_unfreeze) freeze_d = 1'b0;
      else if (gc_freeze) freeze_d = 1'b1;
      if (gc_unsupported) unsupported_d = 1'b1;
    end

    // An answer that has no data (S19, S20)
    if ((source == SRC_INPUTS && input_length_now == 8'd0) || (source == SRC_OUTPUTS && output_length_now == 8'd0) ||
        (source == SRC_CFG && in_use_length_now == 8'd0) || (source == SRC_INIT_CFG && init_cfg_length_q == 8'd0)) begin
      answer = urgent ? ANS_SD1 : ANS_SC;
      fc = FC_DH;
    end else if (source != SRC_NONE) begin
      answer = ANS_SD2;
      fc = urgent ? FC_DH : FC_DL;
    end

    // What follows (S15, S18)
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
  end

  assign answer_o = answer;
  assign answer_fc_o = fc;
  assign answer_source_o = source;
  always_comb begin
    case (source)
      SRC_INPUTS: answer_length_o = input_length_now;
      SRC_OUTPUTS: answer_length_o = output_length_now;
      SRC_CFG: answer_length_o = in_use_length_now;
      SRC_INIT_CFG: answer_length_o = init_cfg_length_q;
      default: answer_length_o = diag_length;
    endcase
  end

  // Slave_Diag's standard bytes (section 11)
  logic [6:0] holder_b;
  logic watchdog_on;
  assign holder_b = accept_prm_b ? wait_sa_q : holder_q;
  assign watchdog_on = wd_commit_dp_o || (dp_control_i && !dp_end_i && !wd_commit_baud_o);
  assign answer_diag_o = {held_b ? {1'b0, holder_b} : 8'hFF, 8'h00,
                          2'b00, sync_b, freeze_b, watchdog_on, 1'b1, diag_stat,
                          state_b == DP_WAIT_PRM && !await_prm_b,
                          1'b0, prm_fault_b, 1'b0, unsupported_b, diag_ext, cfg_fault_b, !in_data_exch, 1'b0};

  assign wd_accept_dp_o = accept_prm && prm_wd_on;
  assign wd_accept_baud_o = accept_prm && !prm_wd_on;
  assign wd_wait_prm_o = enter_wait_prm;
  assign wd_factor_1_o = wd_factor_1_q;
  assign wd_factor_2_o = wd_factor_2_q;
  assign wd_base_1ms_o = wd_base_1ms_q;

  // S18: leaving DATA_EXCH is counted, for whatever reason
  logic left;
  assign left = (leave && !`FAULT(37)) || end_leave || (init_i && state_q == DP_DATA_EXCH);
  assign count_d = left ? count_q + 16'd1 : count_q;

  always_comb begin
    holder_d = holder_b;
    address_d = address_q;
    locked_d = locked_q;
    if (accept_prm) holder_d = sa_i;
    if (set_address) begin
      address_d = new_address;
      locked_d = ssa_lock != 8'h00;
    end
    if (init_i) begin
      holder_d = NO_MASTER;
      address_d = init_address_i;
      locked_d = 1'b0;
    end
  end

  // min_TSDR: 0 leaves it, and 11 is the least (S6, S11)
  function automatic logic [7:0] new_min_tsdr(input logic [7:0] wish, input logic [7:0] old);
    if (wish == 8'd0) new_min_tsdr = old;
    else if (wish < 8'd11) new_min_tsdr = 8'd11;
    else new_min_tsdr = wish;
  endfunction

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
      if (init_i) begin
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

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      min_tsdr_q <= 8'd11;
      {group_q, wd_factor_1_q, wd_factor_2_q} <= 24'd0;
      {sync_req_q, freeze_req_q, fail_safe_q, wd_base_1ms_q, dpv1_q} <= 5'd0;
    end else if (init_i) begin
      min_tsdr_q <= 8'd11;
      {group_q, wd_factor_1_q, wd_factor_2_q} <= 24'd0;
      {sync_req_q, freeze_req_q, fail_safe_q, wd_base_1ms_q, dpv1_q} <= 5'd0;
    end else begin
      if (accept_prm_b) begin
        min_tsdr_q <= new_min_tsdr(wait_min_tsdr_q, min_tsdr_q);
        group_q <= wait_group_q;
        wd_factor_1_q <= wait_factor_1_q;
        wd_factor_2_q <= wait_factor_2_q;
        wd_base_1ms_q <= wait_base_1ms_q;
        sync_req_q <= wait_sync_req_q;
        freeze_req_q <= wait_freeze_req_q;
        fail_safe_q <= wait_fail_safe_q;
        dpv1_q <= wait_dpv1_q;
      end
      if (accept_prm || min_tsdr_only) min_tsdr_q <= new_min_tsdr(prm_min_tsdr, min_tsdr_q);
      if (accept_prm) begin
        group_q <= prm_group;
        wd_factor_1_q <= prm_factor_1;
        wd_factor_2_q <= prm_factor_2;
        wd_base_1ms_q <= prm_base_1ms;
        sync_req_q <= prm_sync_req;
        freeze_req_q <= prm_freeze_req;
        fail_safe_q <= prm_fail_safe;
        dpv1_q <= prm_dpv1;
      end
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      wait_sa_q <= 7'd0;
      {wait_min_tsdr_q, wait_group_q, wait_factor_1_q, wait_factor_2_q} <= 32'd0;
      {wait_sync_req_q, wait_freeze_req_q, wait_fail_safe_q, wait_wd_on_q, wait_base_1ms_q, wait_dpv1_q} <= 6'd0;
    end else if (good_prm) begin
      wait_sa_q <= sa_i;
      wait_min_tsdr_q <= prm_min_tsdr;
      wait_group_q <= prm_group;
      wait_factor_1_q <= prm_factor_1;
      wait_factor_2_q <= prm_factor_2;
      wait_base_1ms_q <= prm_base_1ms;
      wait_sync_req_q <= prm_sync_req;
      wait_freeze_req_q <= prm_freeze_req;
      wait_fail_safe_q <= prm_fail_safe;
      wait_wd_on_q <= prm_wd_on;
      wait_dpv1_q <= prm_dpv1;
    end
  end

  sap_buffers u_buffers (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni),
    .begin_i(begin_i), .data_valid_i(data_valid_i), .data_index_i(data_index_i), .data_i(data_i),
    .stage_inputs_i(stage_inputs_i), .stage_diag_i(stage_diag_i), .stage_we_i(stage_we_i), .stage_pool_i(stage_pool_i),
    .stage_index_i(stage_index_i), .stage_data_i(stage_data_i),
    .init_i(init_i), .init_leave_i(state_q == DP_DATA_EXCH), .init_input_length_i(init_input_length_i),
    .init_output_length_i(init_output_length_i), .commit_inputs_i(inputs_i && inputs_length_i == input_length), .commit_diag_i(diag_store),
    .commit_accept_cfg_i(commit_accept_cfg), .end_leave_i(end_leave),
    .hold_outputs_i(sync_b), .hold_inputs_i(freeze_q), .leave_i(leave), .store_i(store), .clear_i(clear),
    .copy_outputs_i(copy_outputs), .copy_inputs_i(copy_inputs), .mail_prm_i(good_prm), .mail_prm_length_i(prm_user_length),
    .mail_cfg_i(good_cfg), .accept_cfg_i(accept_cfg), .cfg_length_i(length_i), .cfg_input_length_i(cfg_input_length),
    .cfg_output_length_i(cfg_output_length), .input_length_now_o(input_length_now),
    .output_length_now_o(output_length_now), .cfg_length_now_o(in_use_length_now), .last_cfg_length_o(last_cfg_length),
    .peek_index_i(peek_index), .peek_last_i(peek_last), .peek_bus_o(peek_bus), .peek_init_o(peek_init),
    .answer_i(execute_i), .answer_source_i(source), .answer_busy_i(answer_busy_i), .answer_index_i(answer_index_i),
    .answer_data_o(answer_data_o),
    .prm_mail_o(prm_mail_o), .cfg_mail_o(cfg_mail_o), .output_mail_o(output_mail_o), .prm_length_o(prm_length_o),
    .cfg_length_o(cfg_length_o), .cfg_input_length_o(cfg_input_length_o), .cfg_output_length_o(cfg_output_length_o),
    .input_length_o(input_length), .output_length_o(output_length_o), .take_prm_i(take_prm_i), .take_cfg_i(take_cfg_i), .take_output_i(take_output_i),
    .transfer_index_i(transfer_index_i), .transfer_data_o(transfer_data_o));

  assign data_exch_o = in_data_exch;
  assign left_o = leave || end_leave;
  assign dpv1_o = dpv1_q;
  assign ident_o = ident_q;
  assign min_tsdr_o = min_tsdr_q;
  assign address_o = address_q;
  assign initialised_o = initialised_q;
  assign state_o = state_q;
  assign pbf_o = pbf_q;
  assign count_o = count_q;
endmodule
