// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The answer to a telegram's service, and its effect on the DP slave (section 11; S5, S13, S16, S19 to S25, S33), decided at its
// edge, without a register here. Inputs with _b are valid after the commits and the end of DP_CONTROL at the same edge.
`include "profibus_types.svh"

module dp_service (
  `FAULT_PORT
  // the telegram
  input  service_t    service_i,
  input  logic [7:0]  dsap_i,
  input  logic [23:0] head_i,             // first bytes of its data
  input  logic [7:0]  length_i,
  // the DP slave
  input  logic [1:0]  state_i,            // DP_..., _b
  input  logic        sync_i,             // _b
  input  logic        from_holder_i,      // _b
  input  logic        other_holder_i,     // another master is, _b
  input  logic        delivery_address_i, // S33
  input  logic        locked_i,           // No_Add_Chg
  input  logic        fail_safe_i,        // of the parameters in force
  input  logic        urgent_i,           // data exchange is to fetch diagnosis (D9)
  /* verilator lint_off UNUSEDSIGNAL */  // ident, address and the like are others'
  input  initialise_t initial_i,          // the initialisation in force
  /* verilator lint_on UNUSEDSIGNAL */
  // checks of the telegram
  input  logic        prm_fault_i,
  input  logic        prm_unsupported_i,
  input  logic        prm_unlock_i,
  input  logic        prm_min_only_i,
  input  logic        cfg_too_long_i,
  input  logic        cfg_same_i,
  input  logic        cfg_right_i,
  // lengths, _b
  input  logic [7:0]  input_length_i,
  input  logic [7:0]  output_length_i,
  input  logic [7:0]  cfg_length_i,
  input  logic [7:0]  diag_length_i,
  // parameters in force
  input  logic [7:0]  group_i,
  input  logic        sync_req_i,
  input  logic        freeze_req_i,
  output answer_t     answer_o,
  output decision_t   decision_o
);
  logic execute, execute_srd, execute_sdn, refuse, fdl_status, default_sap;
  assign execute = service_i.execute;
  assign execute_srd = service_i.execute && service_i.srd;
  assign execute_sdn = service_i.execute && service_i.sdn && !service_i.default_sap;
  assign refuse = service_i.refuse;
  assign fdl_status = service_i.fdl_status;
  assign default_sap = service_i.default_sap;

  logic gc_acts, gc_clear, gc_unsync, gc_sync, gc_unfreeze, gc_freeze, gc_unsupported;
  global_control u_global_control (
    `FAULT_CONNECT
    .command_i(head_i[7:0]), .group_select_i(head_i[15:8]), .length_i(length_i), .group_ident_i(group_i), .sync_req_i(sync_req_i),
    .freeze_req_i(freeze_req_i), .can_sync_i(initial_i.sync), .can_freeze_i(initial_i.freeze), .acts_o(gc_acts),
    .clear_o(gc_clear), .unsync_o(gc_unsync), .sync_o(gc_sync), .unfreeze_o(gc_unfreeze), .freeze_o(gc_freeze),
    .unsupported_o(gc_unsupported));

  logic in_data_exch, wait_prm, wait_cfg, urgent, user_judges_prm, user_judges_cfg, fits_outputs, is_empty, has_data, supports_address;
  logic ssa_ident_right;
  logic [7:0] ssa_address, init_cfg_length;
  assign ssa_address = head_i[7:0];
  assign ssa_ident_right = {head_i[15:8], head_i[23:16]} == initial_i.ident;
  assign in_data_exch = state_i == DP_DATA_EXCH;
  assign wait_prm = state_i == DP_WAIT_PRM;
  assign wait_cfg = state_i == DP_WAIT_CFG;
  assign urgent = urgent_i && default_sap;  // D9: only data exchange says so
  assign user_judges_prm = initial_i.prm_mode == 2'd2;
  assign user_judges_cfg = initial_i.cfg_mode == 2'd2;
  assign init_cfg_length = initial_i.cfg_length;
  assign fits_outputs = length_i == output_length_i;
  assign is_empty = length_i == 8'd0;
  assign has_data = !is_empty && !`FAULT(124);  // S13
  assign supports_address = initial_i.set_address;

  logic [2:0] answer;
  logic [7:0] fc;
  logic [2:0] source;
  logic good_prm, accept_prm, good_cfg, accept_cfg, min_tsdr_only, set_address, store, clear, diag_read, enter_wait_prm;
  logic prm_fault, cfg_fault, not_supported, global_control;
  always_comb begin
    answer = ANS_NONE;
    fc = FC_OK;
    source = SRC_NONE;
    good_prm = 1'b0;
    accept_prm = 1'b0;
    good_cfg = 1'b0;
    accept_cfg = 1'b0;
    min_tsdr_only = 1'b0;
    set_address = 1'b0;
    store = 1'b0;
    clear = 1'b0;
    diag_read = 1'b0;
    enter_wait_prm = 1'b0;
    prm_fault = 1'b0;
    cfg_fault = 1'b0;
    not_supported = 1'b0;
    global_control = 1'b0;

    if (execute && fdl_status) answer = ANS_SD1;
    if (execute && refuse) begin
      answer = ANS_SD1;
      fc = FC_RS;
    end

    if (execute_srd && default_sap) begin
      // Data exchange (6.2.5, S19)
      answer = ANS_SD1;
      fc = FC_RS;
      if (in_data_exch && from_holder_i) begin
        if (fits_outputs) begin
          store = 1'b1;
          source = SRC_INPUTS;
        end else if (fail_safe_i && is_empty) begin
          clear = 1'b1;
          source = SRC_INPUTS;
        end else begin
          fc = FC_RR;
          cfg_fault = 1'b1;
          enter_wait_prm = 1'b1;
        end
      end
    end else if (execute_srd) begin
      answer = ANS_SD1;
      fc = FC_RS;
      case (dsap_i)
        SAP_SET_ADDRESS: begin  // 6.2.1, S5, S25
          if (wait_prm && supports_address && (!locked_i || `FAULT(35))) begin
            if (length_i > 8'd4) fc = FC_RR;
            else begin
              answer = ANS_SC;
              set_address = length_i == 8'd4 && ssa_ident_right && ssa_address <= 8'd125;
`ifdef SINGLE_FAULTS
              if (`FAULT(176) && ssa_address == 8'd126) set_address = length_i == 8'd4 && ssa_ident_right;
`endif
            end
          end
        end
        SAP_READ_INPUTS, SAP_READ_OUTPUTS: begin
          if (in_data_exch || (wait_cfg && `FAULT(156)) || (has_data && `FAULT(157))) begin
            if (has_data) fc = FC_RR;
            else source = dsap_i == SAP_READ_INPUTS ? SRC_INPUTS : SRC_OUTPUTS;
          end
        end
        SAP_GET_CFG: begin
          if (has_data) fc = FC_RR;
          else source = in_data_exch || `FAULT(36) ? SRC_CFG : SRC_INIT_CFG;
        end
        SAP_SLAVE_DIAG: begin  // S23
          if (has_data) fc = FC_RR;
          else begin
            source = SRC_DIAG;
            diag_read = from_holder_i;
          end
        end
        SAP_SET_PRM: begin
          if (!other_holder_i && !delivery_address_i) begin
            answer = ANS_SC;
            if (prm_fault_i) begin
              prm_fault = 1'b1;
              if (prm_unsupported_i) not_supported = 1'b1;
              enter_wait_prm = 1'b1;
            end else if (prm_unlock_i) begin
              enter_wait_prm = 1'b1;
            end else if (prm_min_only_i) begin
              min_tsdr_only = 1'b1;
            end else begin
              good_prm = 1'b1;
              accept_prm = !user_judges_prm;
            end
          end
        end
        SAP_CHECK_CFG: begin
          if ((wait_cfg || in_data_exch) && from_holder_i) begin
            if (cfg_too_long_i) fc = FC_RR;
            else begin
              answer = ANS_SC;
              if (in_data_exch ? cfg_same_i : cfg_right_i) begin
                good_cfg = 1'b1;
                accept_cfg = !in_data_exch && !user_judges_cfg;
              end else begin
                cfg_fault = 1'b1;
                enter_wait_prm = 1'b1;
              end
            end
          end
        end
        default: ;
      endcase
    end else if (execute_sdn && dsap_i == SAP_GLOBAL_CONTROL && in_data_exch && from_holder_i) begin
      // Global_Control (6.2.6, S24)
      global_control = 1'b1;
    end

    // An answer that has no data (S19, S20)
    if ((source == SRC_INPUTS && input_length_i == 8'd0) || (source == SRC_OUTPUTS && output_length_i == 8'd0) ||
        (source == SRC_CFG && cfg_length_i == 8'd0) || (source == SRC_INIT_CFG && init_cfg_length == 8'd0)) begin
      answer = urgent ? ANS_SD1 : ANS_SC;
      fc = FC_DH;
    end else if (source != SRC_NONE) begin
      answer = ANS_SD2;
      fc = urgent ? FC_DH : FC_DL;
    end
  end

  assign answer_o.kind = answer;
  assign answer_o.fc = fc;
  assign answer_o.source = source;
  logic [7:0] length;
  always_comb begin
    case (source)
      SRC_INPUTS: length = input_length_i;
      SRC_OUTPUTS: length = output_length_i;
      SRC_CFG: length = cfg_length_i;
      SRC_INIT_CFG: length = init_cfg_length;
      default: length = diag_length_i;
    endcase
  end
  assign answer_o.length = length;

  assign decision_o.good_prm = good_prm;
  assign decision_o.accept_prm = accept_prm;
  assign decision_o.good_cfg = good_cfg;
  assign decision_o.accept_cfg = accept_cfg;
  assign decision_o.min_tsdr_only = min_tsdr_only;
  assign decision_o.set_address = set_address;
  assign decision_o.store = store;
  assign decision_o.clear = clear || (global_control && gc_clear);
  assign decision_o.copy_outputs =
`ifdef SINGLE_FAULTS
      (`FAULT(191) && global_control && gc_unsync) ||
`endif
      global_control && (gc_sync || (gc_unsync && sync_i));
  assign decision_o.copy_inputs = global_control && (gc_freeze || gc_unfreeze);
  assign decision_o.diag_read = diag_read;
  assign decision_o.enter_wait_prm = enter_wait_prm;
  assign decision_o.prm_fault = prm_fault;
  assign decision_o.cfg_fault = cfg_fault;
  assign decision_o.not_supported = not_supported || (global_control && gc_unsupported);
  assign decision_o.global_control = global_control && gc_acts;
  assign decision_o.sync = global_control && gc_sync;
  assign decision_o.unsync = global_control && gc_unsync;
  assign decision_o.freeze = global_control && gc_freeze;
  assign decision_o.unfreeze = global_control && gc_unfreeze;
endmodule
