// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Buffers of the SAPs (6.1, figure 8; S4, S18, S27) and the mail for the user (section 3).
//
// Nothing is copied at a decision: bytes are received into a free bank, and a decision only changes which bank is which buffer. So a
// transfer or an answer keeps its bytes while newer ones arrive. Events of one edge act in the order of section 3: the
// user's side's commits, the end of DP_CONTROL, the telegram. Outputs with _now include the first two.
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
  /* verilator lint_off UNUSEDSIGNAL */
  input  stage_t     stage_i,
  /* verilator lint_on UNUSEDSIGNAL */
  // commits
  /* verilator lint_off UNUSEDSIGNAL */
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
  /* verilator lint_off UNUSEDSIGNAL */
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
  /* verilator lint_off UNUSEDSIGNAL */
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

  // ---- banks of the bus side: outputs 1 and 2, parameters, the last configuration, the one in use, the transfer, the telegram
  logic [2:0] out1_q, out2_q, prm_q, last_q, in_use_q, transfer_q, receive_q;
  logic [2:0] out1_d, out2_d, in_use_d;
  logic out1_zero_q, out1_zero_d, out2_zero_q, out2_zero_d, transfer_zero_q, transfer_is_output_q;
  logic prm_mail_q, cfg_mail_q, output_mail_q, output_mail_d;
  logic [7:0] prm_length_q, last_length_q, last_input_q, last_output_q;
  logic [7:0] in_use_length_q, in_use_length_d, input_length_q, input_length_d, output_length_q, output_length_d;

  // ---- banks of the user's side: inputs 1 and 2, diagnosis, and those being read
  logic [1:0] in1_q, in2_q, in1_d, in2_d, diag_q, diag_d, stage_inputs_q, stage_diag_q;
  logic in1_zero_q, in2_zero_q, in1_zero_d, in2_zero_d;
  logic init_q;

  logic clears_inputs;
  assign clears_inputs = last_input_q != input_length_q;

  // Values after the commits and the end of DP_CONTROL
  logic [1:0] in1_b, in2_b, diag_b;
  logic in1_zero_b, in2_zero_b;
  logic [2:0] in_use_b;
  always_comb begin
    in1_b = in1_q;
    in2_b = in2_q;
    in1_zero_b = in1_zero_q;
    in2_zero_b = in2_zero_q;
    input_length_now_o = input_length_q;
    output_length_now_o = output_length_q;
    cfg_length_now_o = in_use_length_q;
    in_use_b = in_use_q;
    diag_b = commit_diag_i ? stage_diag_q : diag_q;
    if (commit_inputs_i) begin
      in1_b = stage_inputs_q;
      in1_zero_b = 1'b0;
      if (!hold_inputs_i || `FAULT(28)) begin
        in2_b = stage_inputs_q;
        in2_zero_b = 1'b0;
      end
    end
    if (commit_accept_cfg_i) begin
      in_use_b = last_q;
      input_length_now_o = last_input_q;
      output_length_now_o = last_output_q;
      cfg_length_now_o = last_length_q;
      if (clears_inputs) begin
        in1_zero_b = 1'b1;
        in2_zero_b = 1'b1;
      end
    end
    if (end_leave_i) begin
      in2_b = in1_b;
      in2_zero_b = in1_zero_b;
    end
  end

  // Inputs and configuration after the telegram
  always_comb begin
    in1_d = in1_b;
    in2_d = in2_b;
    in1_zero_d = in1_zero_b;
    in2_zero_d = in2_zero_b;
    diag_d = diag_b;
    in_use_d = in_use_b;
    input_length_d = input_length_now_o;
    output_length_d = output_length_now_o;
    in_use_length_d = cfg_length_now_o;
    if (leave_i || (copy_inputs && !`FAULT(29))) begin
      in2_d = in1_b;
      in2_zero_d = in1_zero_b;
    end
`ifdef SINGLE_FAULTS
    if (`FAULT(193) && leave_i && hold_inputs_i) begin
      in2_d = in2_b;
      in2_zero_d = in2_zero_b;
    end
`endif
    if (accept_cfg) begin
      in_use_d = receive_q;
      input_length_d = cfg_input_length_i;
      output_length_d = cfg_output_length_i;
      in_use_length_d = cfg_length_i;
      if (cfg_input_length_i != input_length_now_o) begin
        in1_zero_d = 1'b1;
        in2_zero_d = 1'b1;
      end
    end
  end

  logic take_output;
  assign take_output = take_i.outputs;

  // Outputs. An item taken at this edge is removed before a new one arrives.
  always_comb begin
    out1_d = out1_q;
    out2_d = out2_q;
    out1_zero_d = out1_zero_q;
    out2_zero_d = out2_zero_q;
    output_mail_d = output_mail_q && !take_output;
    if (commit_accept_cfg_i || end_leave_i || leave_i || clear || accept_cfg) begin
      out1_zero_d = !`FAULT(30);
      out2_zero_d = !`FAULT(30);
    end
    if ((end_leave_i || leave_i || clear) && output_length_now_o != 8'd0) output_mail_d = 1'b1;
    if (store) begin
      out1_d = receive_q;
      out1_zero_d = 1'b0;
    end
    if ((store && (!hold_outputs_i || `FAULT(31))) || copy_outputs) begin
      out2_d = out1_d;
      out2_zero_d = out1_zero_d;
      if (output_length_now_o != 8'd0) output_mail_d = 1'b1;
    end
    // Outputs of length 0 are never mail, nor are waiting ones when the length becomes 0
    if (output_length_d == 8'd0) output_mail_d = 1'b0;
  end

  // Unused banks
  logic [6:0] used, bit_out1, bit_out2, bit_prm, bit_last, bit_in_use, bit_transfer;
  logic [2:0] free;
  assign bit_out1 = 7'd1 << out1_q;
  assign bit_out2 = 7'd1 << out2_q;
  assign bit_prm = 7'd1 << prm_q;
  assign bit_last = 7'd1 << last_q;
  assign bit_in_use = 7'd1 << in_use_q;
  assign bit_transfer = 7'd1 << transfer_q;
  assign used = bit_out1 | bit_out2 | bit_prm | bit_last | bit_in_use | bit_transfer;
  always_comb begin
    casez (used)
      7'b??????0: free = 3'd0;
      7'b?????01: free = 3'd1;
      7'b????011: free = 3'd2;
      7'b???0111: free = 3'd3;
      7'b??01111: free = 3'd4;
      7'b?011111: free = 3'd5;
      default: free = 3'd6;
    endcase
  end

  // ---- the answer's source
  logic [2:0] source_q, source_bus_q;
  logic [1:0] source_user_q;
  logic source_zero_q;
  logic answer_reads_inputs, answer_reads_diag;
  assign answer_reads_inputs = answer_busy_i && source_q == SRC_INPUTS;
  assign answer_reads_diag = answer_busy_i && source_q == SRC_DIAG;

  logic [1:0] free_inputs, free_diag;
  function automatic logic [1:0] other_than(input logic [1:0] a, input logic [1:0] b, input logic [1:0] c);
    if (a != 2'd0 && b != 2'd0 && c != 2'd0) other_than = 2'd0;
    else if (a != 2'd1 && b != 2'd1 && c != 2'd1) other_than = 2'd1;
    else if (a != 2'd2 && b != 2'd2 && c != 2'd2) other_than = 2'd2;
    else other_than = 2'd3;
  endfunction
  assign free_inputs = other_than(in1_q, in2_q, answer_reads_inputs ? source_user_q : in2_q);
  assign free_diag = other_than(diag_q, diag_q, answer_reads_diag ? source_user_q : diag_q);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {out1_q, out2_q, prm_q, last_q, in_use_q, transfer_q, receive_q} <= 21'd0;
      {out1_zero_q, out2_zero_q, in1_zero_q, in2_zero_q} <= 4'b1111;
      {transfer_zero_q, transfer_is_output_q} <= 2'b00;
      {prm_mail_q, cfg_mail_q, output_mail_q} <= 3'b000;
      {prm_length_q, last_length_q, last_input_q, last_output_q} <= 32'd0;
      {in_use_length_q, input_length_q, output_length_q} <= 24'd0;
      {in1_q, in2_q, diag_q, stage_inputs_q, stage_diag_q} <= 10'd0;
      init_q <= 1'b0;
      source_q <= SRC_NONE;
      source_bus_q <= 3'd0;
      source_user_q <= 2'd0;
      source_zero_q <= 1'b0;
    end else begin
      if (begin_i) receive_q <= free;
      if (stage_i.inputs) stage_inputs_q <= free_inputs;
      if (stage_i.diagnosis) stage_diag_q <= free_diag;
      if (take_i.parameters) transfer_q <= prm_q;
      if (take_i.configuration) transfer_q <= last_q;
      if (take_i.outputs) transfer_q <= `FAULT(32) ? out1_q : out2_q;
      if (take_i.parameters || take_i.configuration || take_i.outputs) begin
        transfer_is_output_q <= take_i.outputs;
        transfer_zero_q <= out2_zero_q;
      end

      out1_q <= out1_d;
      out2_q <= out2_d;
      out1_zero_q <= out1_zero_d;
      out2_zero_q <= out2_zero_d;
      in1_q <= in1_d;
      in2_q <= in2_d;
      in1_zero_q <= in1_zero_d;
      in2_zero_q <= in2_zero_d;
      diag_q <= diag_d;
      in_use_q <= in_use_d;
      in_use_length_q <= in_use_length_d;
      input_length_q <= input_length_d;
      output_length_q <= output_length_d;
      output_mail_q <= output_mail_d;
      prm_mail_q <= mail_prm || (prm_mail_q && !take_i.parameters);
      cfg_mail_q <= mail_cfg || (cfg_mail_q && !take_i.configuration);
      if (mail_prm) begin
        prm_q <= receive_q;
        prm_length_q <= mail_prm_length_i;
      end
      if (mail_cfg) begin
        last_q <= receive_q;
        last_length_q <= cfg_length_i;
        last_input_q <= cfg_input_length_i;
        last_output_q <= cfg_output_length_i;
      end
      if (answer_i) begin
        source_q <= answer_source_i;
        source_bus_q <= answer_source_i == SRC_OUTPUTS ? out2_q : in_use_b;
        source_user_q <= answer_source_i == SRC_INPUTS ? (`FAULT(33) ? in1_b : in2_b) :
                         answer_source_i == SRC_DIAG ? diag_b : {1'b0, init_q};
        source_zero_q <= (answer_source_i == SRC_INPUTS && in2_zero_b) ||
                         (answer_source_i == SRC_OUTPUTS && (out2_zero_q || commit_accept_cfg_i));
      end

      if (init_i.commit) begin
        init_q <= !init_q;
        {out1_zero_q, out2_zero_q, in1_zero_q, in2_zero_q} <= 4'b1111;
        {prm_mail_q, cfg_mail_q} <= 2'b00;
        output_mail_q <= init_leave_i && init_i.output_length != 8'd0;
        in_use_length_q <= 8'd0;
        input_length_q <= init_i.input_length;
        output_length_q <= init_i.output_length;
      end
    end
  end

  // ---- memories
  logic [10:0] bus_write, bus_answer, bus_transfer;
  logic [2:0] transfer_bank;
  logic [7:0] bus_answer_data, bus_transfer_data;
  assign bus_write = {receive_q, data_index_i};
  assign transfer_bank = take_i.parameters ? prm_q : take_i.configuration ? last_q :
                         take_output ? (`FAULT(32) ? out1_q : out2_q) : transfer_q;
  assign bus_transfer = {transfer_bank, take_i.index};
  assign bus_answer = answer_busy_i ? {source_bus_q, answer_index_i} : {peek_last_i ? last_q : in_use_q, peek_index_i};

  buffer_ram #(.ADDRESS_BITS(11), .BYTES(2048)) u_bus_transfer (
    .clk_i(clk_i), .we_i(data_valid_i), .waddr_i(bus_write), .wdata_i(data_i),
    .raddr_i(bus_transfer), .rdata_o(bus_transfer_data));
  buffer_ram #(.ADDRESS_BITS(11), .BYTES(2048)) u_bus_answer (
    .clk_i(clk_i), .we_i(data_valid_i), .waddr_i(bus_write), .wdata_i(data_i),
    .raddr_i(bus_answer), .rdata_o(bus_answer_data));

  logic [11:0] user_write, user_read;
  logic [1:0] stage_bank, source_pool;
  logic [7:0] user_data;
  assign stage_bank = stage_i.pool == POOL_INPUTS ? stage_inputs_q : stage_i.pool == POOL_DIAG ? stage_diag_q : {1'b0, !init_q};
  assign source_pool = source_q == SRC_INPUTS ? POOL_INPUTS : source_q == SRC_DIAG ? POOL_DIAG : POOL_INIT;
  assign user_write = {stage_i.pool, stage_bank, stage_i.index};
  assign user_read = answer_busy_i ? {source_pool, source_user_q, answer_index_i} : {POOL_INIT, 1'b0, init_q, peek_index_i};

  buffer_ram #(.ADDRESS_BITS(12), .BYTES(2560)) u_user (
    .clk_i(clk_i), .we_i(stage_i.we), .waddr_i(user_write), .wdata_i(stage_i.data),
    .raddr_i(user_read), .rdata_o(user_data));

  assign answer_data_o = source_zero_q ? 8'd0 : source_q == SRC_OUTPUTS || source_q == SRC_CFG ? bus_answer_data : user_data;
  assign peek_bus_o = bus_answer_data;
  assign peek_init_o = user_data;
  assign mail_data_o = transfer_is_output_q && transfer_zero_q ? 8'd0 : bus_transfer_data;
  assign mail_o.parameters = {prm_mail_q, prm_length_q};
  assign mail_o.configuration = {cfg_mail_q, last_length_q, last_input_q, last_output_q};
  assign mail_o.outputs = {output_mail_q, output_length_q};
  assign input_length_o = input_length_q;
  assign last_cfg_length_o = last_length_q;
endmodule
