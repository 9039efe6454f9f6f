// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Buffers of the SAPs (6.1, figure 8; S4, S18, S27) and the mail for the user (section 3).
//
// Nothing is copied at a decision: bytes are received into a free bank, and a decision only changes which bank is which buffer. So a
// transfer or an answer keeps its bytes while newer ones arrive. Events of one edge act in the order of section 3: the
// user's side's commits, the end of DP_CONTROL, the telegram. Outputs with _now include the first two.
// bus_banks and user_banks know which bank is which; here are lengths, mail, the answer's source and the memories.
`include "profibus_types.svh"

module sap_buffers (
  `FAULT_PORT
  input  logic       clk_i,
  input  logic       rst_ni,
  // bytes from the bus
  input  logic       begin_i,
  input  logic       data_valid_i,
  input  logic [7:0] data_index_i,
  input  logic [7:0] data_i,
  // bytes from the user, on their way into spare banks
  /* verilator lint_off UNUSEDSIGNAL */  // bytes of acyclic answers are msac_buffers'
  input  stage_t     stage_i,
  /* verilator lint_on UNUSEDSIGNAL */
  // commits
  /* verilator lint_off UNUSEDSIGNAL */  // the other values are dp_slave's
  input  initialise_t init_i,
  /* verilator lint_on UNUSEDSIGNAL */
  input  logic       init_leave_i,
  input  logic       commit_inputs_i,
  input  logic       commit_diag_i,
  input  logic       commit_accept_cfg_i,
  // end of DP_CONTROL in DATA_EXCH
  input  logic       end_leave_i,
  // the telegram
  input  logic       hold_outputs_i,  // sync holds
  input  logic       hold_inputs_i,   // freeze holds, before the edge
  input  logic       leave_i,
  /* verilator lint_off UNUSEDSIGNAL */  // the other decisions are dp_slave's
  input  decision_t  decision_i,
  /* verilator lint_on UNUSEDSIGNAL */
  input  logic [7:0] mail_prm_length_i,
  input  logic [7:0] cfg_length_i,
  input  logic [7:0] cfg_input_length_i,
  input  logic [7:0] cfg_output_length_i,
  output logic [7:0] input_length_o,
  output logic [7:0] input_length_now_o,
  output logic [7:0] output_length_now_o,
  output logic [7:0] cfg_length_now_o,
  output logic [7:0] last_cfg_length_o,
  // comparison of Check_Cfg
  input  logic [7:0] peek_index_i,
  input  logic       peek_last_i,
  output logic [7:0] peek_bus_o,
  output logic [7:0] peek_init_o,
  // the answer
  input  logic       answer_i,        // the source is fixed at this edge
  input  logic [2:0] answer_source_i,
  input  logic       answer_busy_i,
  input  logic [7:0] answer_index_i,
  output logic [7:0] answer_data_o,
  // mail for the user
  output dp_mail_t   mail_o,
  /* verilator lint_off UNUSEDSIGNAL */  // acyclic mail is msac_buffers'
  input  take_t      take_i,
  /* verilator lint_on UNUSEDSIGNAL */
  output logic [7:0] mail_data_o
);
  logic store, clear, copy_outputs, copy_inputs, mail_prm, mail_cfg, accept_cfg;
  assign store = decision_i.store;
  assign clear = decision_i.clear;
  assign copy_outputs = decision_i.copy_outputs;
  assign copy_inputs = decision_i.copy_inputs;
  assign mail_prm = decision_i.good_prm;
  assign mail_cfg = decision_i.good_cfg;
  assign accept_cfg = decision_i.accept_cfg;

  // ---- lengths: of parameters, of the last configuration, of the one in use
  logic [7:0] prm_length_q, last_length_q, last_input_q, last_output_q;
  logic [7:0] in_use_length_q, in_use_length_d, input_length_q, input_length_d, output_length_q, output_length_d;
  logic init;
  assign init = init_i.commit;
  assign input_length_now_o = commit_accept_cfg_i ? last_input_q : input_length_q;
  assign output_length_now_o = commit_accept_cfg_i ? last_output_q : output_length_q;
  assign cfg_length_now_o = commit_accept_cfg_i ? last_length_q : in_use_length_q;
  assign input_length_d = accept_cfg ? cfg_input_length_i : input_length_now_o;
  assign output_length_d = accept_cfg ? cfg_output_length_i : output_length_now_o;
  assign in_use_length_d = accept_cfg ? cfg_length_i : cfg_length_now_o;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {prm_length_q, last_length_q, last_input_q, last_output_q} <= 32'd0;
    end else begin
      if (mail_prm) prm_length_q <= mail_prm_length_i;
      if (mail_cfg) begin
        last_length_q <= cfg_length_i;
        last_input_q <= cfg_input_length_i;
        last_output_q <= cfg_output_length_i;
      end
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {in_use_length_q, input_length_q, output_length_q} <= 24'd0;
    end else if (init) begin
      in_use_length_q <= 8'd0;
      input_length_q <= init_i.input_length;
      output_length_q <= init_i.output_length;
    end else begin
      in_use_length_q <= in_use_length_d;
      input_length_q <= input_length_d;
      output_length_q <= output_length_d;
    end
  end

  // ---- banks of the bus side
  logic [2:0] receive, last, in_use, in_use_b, out2, transfer;
  logic out2_zero, transfer_zero, outputs_new;
  bus_banks u_bus_banks (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .begin_i(begin_i), .init_i(init), .take_prm_i(take_i.parameters), .take_cfg_i(take_i.configuration),
    .take_outputs_i(take_i.outputs), .prm_i(mail_prm), .cfg_i(mail_cfg), .store_i(store), .commit_accept_cfg_i(commit_accept_cfg_i),
    .accept_cfg_i(accept_cfg), .hold_i(hold_outputs_i), .copy_i(copy_outputs), .clear_i(clear), .leave_i(leave_i),
    .end_leave_i(end_leave_i), .outputs_new_o(outputs_new), .receive_o(receive), .last_o(last), .in_use_o(in_use),
    .in_use_now_o(in_use_b), .out2_o(out2), .out2_zero_o(out2_zero), .transfer_o(transfer), .transfer_zero_o(transfer_zero));

  // ---- banks of the user's side. Other lengths of the inputs clear them
  logic [2:0] source_q;
  logic [1:0] source_user_q, in1, in2, diag, stage_inputs, stage_diag;
  logic in2_zero, init_bank, clear_commit, clear_telegram, sends_inputs, sends_diag;
  assign clear_commit = commit_accept_cfg_i && last_input_q != input_length_q;
  assign clear_telegram = accept_cfg && cfg_input_length_i != input_length_now_o;
  assign sends_inputs = answer_busy_i && source_q == SRC_INPUTS;
  assign sends_diag = answer_busy_i && source_q == SRC_DIAG;
  user_banks u_user_banks (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .init_i(init), .begin_inputs_i(stage_i.inputs), .begin_diag_i(stage_i.diagnosis),
    .commit_inputs_i(commit_inputs_i), .commit_diag_i(commit_diag_i), .clear_commit_i(clear_commit), .end_leave_i(end_leave_i),
    .hold_i(hold_inputs_i), .copy_i(copy_inputs), .leave_i(leave_i), .clear_telegram_i(clear_telegram),
    .sends_inputs_i(sends_inputs), .sends_diag_i(sends_diag), .sent_i(source_user_q), .in1_o(in1), .in2_o(in2), .in2_zero_o(in2_zero),
    .diag_o(diag), .stage_inputs_o(stage_inputs), .stage_diag_o(stage_diag), .init_o(init_bank));

  // ---- mail. An item that is taken at this edge is removed before a new one arrives
  logic prm_mail_q, cfg_mail_q, output_mail_q, output_mail_d;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {prm_mail_q, cfg_mail_q} <= 2'b00;
    end else begin
      prm_mail_q <= !init && (mail_prm || (prm_mail_q && !take_i.parameters));
      cfg_mail_q <= !init && (mail_cfg || (cfg_mail_q && !take_i.configuration));
    end
  end

  // Outputs of length 0 are never mail, nor are waiting ones when the length becomes 0
  logic outputs_wait;
  assign outputs_wait = (outputs_new && output_length_now_o != 8'd0) || (output_mail_q && !take_i.outputs);
  assign output_mail_d = outputs_wait && output_length_d != 8'd0;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) output_mail_q <= 1'b0;
    else if (init) output_mail_q <= init_leave_i && init_i.output_length != 8'd0;
    else output_mail_q <= output_mail_d;
  end

  // ---- the answer's source, from the decision on
  logic [2:0] source_bus_q;
  logic source_zero_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      source_q <= SRC_NONE;
      source_bus_q <= 3'd0;
      source_user_q <= 2'd0;
      source_zero_q <= 1'b0;
    end else if (answer_i) begin
      source_q <= answer_source_i;
      source_bus_q <= answer_source_i == SRC_OUTPUTS ? out2 : in_use_b;
      source_user_q <= answer_source_i == SRC_INPUTS ? (`FAULT(33) ? in1 : in2) : answer_source_i == SRC_DIAG ? diag : {1'b0, init_bank};
      source_zero_q <= (answer_source_i == SRC_INPUTS && in2_zero) ||
                       (answer_source_i == SRC_OUTPUTS && (out2_zero || commit_accept_cfg_i));
    end
  end

  // ---- memories
  logic [10:0] bus_write, bus_answer, bus_transfer;
  logic [7:0] bus_answer_data, bus_transfer_data;
  assign bus_write = {receive, data_index_i};
  assign bus_transfer = {transfer, take_i.index};
  assign bus_answer = answer_busy_i ? {source_bus_q, answer_index_i} : {peek_last_i ? last : in_use, peek_index_i};

  buffer_ram #(.ADDRESS_BITS(11), .BYTES(2048)) u_bus_transfer (
    .clk_i(clk_i), .we_i(data_valid_i), .waddr_i(bus_write), .wdata_i(data_i),
    .raddr_i(bus_transfer), .rdata_o(bus_transfer_data));
  buffer_ram #(.ADDRESS_BITS(11), .BYTES(2048)) u_bus_answer (
    .clk_i(clk_i), .we_i(data_valid_i), .waddr_i(bus_write), .wdata_i(data_i),
    .raddr_i(bus_answer), .rdata_o(bus_answer_data));

  logic [11:0] user_write, user_read;
  logic [1:0] stage_bank, source_pool;
  logic [7:0] user_data;
  assign stage_bank = stage_i.pool == POOL_INPUTS ? stage_inputs : stage_i.pool == POOL_DIAG ? stage_diag : {1'b0, !init_bank};
  assign source_pool = source_q == SRC_INPUTS ? POOL_INPUTS : source_q == SRC_DIAG ? POOL_DIAG : POOL_INIT;
  assign user_write = {stage_i.pool, stage_bank, stage_i.index};
  assign user_read = answer_busy_i ? {source_pool, source_user_q, answer_index_i} : {POOL_INIT, 1'b0, init_bank, peek_index_i};

  buffer_ram #(.ADDRESS_BITS(12), .BYTES(2560)) u_user (
    .clk_i(clk_i), .we_i(stage_i.we), .waddr_i(user_write), .wdata_i(stage_i.data),
    .raddr_i(user_read), .rdata_o(user_data));

  assign answer_data_o = source_zero_q ? 8'd0 : source_q == SRC_OUTPUTS || source_q == SRC_CFG ? bus_answer_data : user_data;
  assign peek_bus_o = bus_answer_data;
  assign peek_init_o = user_data;
  assign mail_data_o = transfer_zero ? 8'd0 : bus_transfer_data;
  assign mail_o.parameters = {prm_mail_q, prm_length_q};
  assign mail_o.configuration = {cfg_mail_q, last_length_q, last_input_q, last_output_q};
  assign mail_o.outputs = {output_mail_q, output_length_q};
  assign input_length_o = input_length_q;
  assign last_cfg_length_o = last_length_q;
endmodule
