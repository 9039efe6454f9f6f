// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// DPV1 (section 15): hands telegrams to SAPs 51, 49, 48 and 47 to MSAC_C1 and MSAC_C2, and the user's answers to the request that is
// with them.
`include "profibus_types.svh"

module msac (
  `FAULT_PORT
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        init_i,           // an initialisation is committed
  // the DP slave
  input  logic        left_i,           // DATA_EXCH is left at this edge
  input  logic        data_exch_i,      // after the commits
  input  logic        from_holder_i,
  input  logic        prm_dpv1_i,       // DPV1_Enable of the Set_Prm in force
  input  logic        dpv1_on_i,        // D17
  // the telegram
  input  logic        data_valid_i,
  input  logic [7:0]  data_index_i,
  input  logic [7:0]  data_i,
  input  logic [63:0] head_i,
  input  logic [7:0]  length_i,
  input  logic [7:0]  sa_i,
  input  logic [7:0]  ssap_i,
  input  logic [7:0]  dsap_i,
  /* verilator lint_off UNUSEDSIGNAL */  // services of the DP slave are dp_service's
  input  service_t    service_i,
  /* verilator lint_on UNUSEDSIGNAL */
  output logic        replies_o,        // it is a service of this block: what follows is the answer
  output answer_t     reply_o,
  input  logic [7:0]  reply_index_i,
  output logic [7:0]  reply_data_o,
  // the user's side
  output acyclic_mail_t c1_o,           // requests for the user
  output acyclic_mail_t c2_o,
  input  answers_t    answers_i,        // the user's answers
  /* verilator lint_off UNUSEDSIGNAL */  // blocks of the DP slave are sap_buffers'
  input  stage_t      stage_i,
  input  take_t       take_i,
  /* verilator lint_on UNUSEDSIGNAL */
  output logic [7:0]  mail_data_o
);
  // ---- the telegram stands still long before the decision: through registers
  logic c1_sap_q, initiate_sap_q, c30_sap_q, c2f_sap_q, ssap_51_q, ssap_50_q, has_sap;
  assign has_sap = !service_i.default_sap && (service_i.srd || service_i.sdn);
  always_ff @(posedge clk_i) begin
    c1_sap_q <= has_sap && dsap_i == SAP_MSAC_C1;
    initiate_sap_q <= has_sap && dsap_i == SAP_INITIATE;
    c30_sap_q <= has_sap && dsap_i == SAP_MSAC_30;
    c2f_sap_q <= has_sap && dsap_i == SAP_MSAC_2F;
    ssap_51_q <= sa_i[7] && ssap_i == SAP_MSAC_C1;
    ssap_50_q <= sa_i[7] && ssap_i == SAP_MASTER_C2;
  end

  logic poll, abort, idle, initiate_again, initiate_legal, long_form, c2_right;
  logic [1:0] c1_code, initiate_code;
  logic [7:0] s_length, d_length;
  logic [15:0] timeout;
  logic [23:0] head;
  assign head = head_i[23:0];
  request_check u_request_check (
    `FAULT_CONNECT
    .clk_i(clk_i), .function_i(head_i[7:0]), .data_length_i(head_i[31:24]), .length_i(length_i), .poll_o(poll),
    .abort_o(abort), .idle_o(idle), .initiate_o(initiate_again), .c1_code_o(c1_code), .c2_right_o(c2_right));
  initiate_check u_initiate_check (
    `FAULT_CONNECT
    .clk_i(clk_i), .head_i(head_i), .length_i(length_i), .valid_i(data_valid_i), .index_i(data_index_i), .data_i(data_i),
    .legal_o(initiate_legal), .timeout_o(timeout), .code_o(initiate_code), .long_o(long_form), .s_length_o(s_length),
    .d_length_o(d_length));

  logic c1_srd, initiate_srd, srd;
  logic [1:0] channel_srd, channel_sdn;
  assign srd = service_i.execute && service_i.srd;
  assign c1_srd = srd && c1_sap_q;
  assign initiate_srd = srd && initiate_sap_q;
  assign channel_srd = srd ? {c2f_sap_q, c30_sap_q} : 2'b00;
  assign channel_sdn = service_i.execute && service_i.sdn ? {c2f_sap_q, c30_sap_q} : 2'b00;

  // ---- the user's answer against the request with the user (V6, V14), while its first bytes arrive
  logic stage, staged_c2_q, error_q, function_same_q, slot_same_q, index_same_q, fits, c1_answer, c2_answer;
  logic c1_with_user, c2_with_user, owner_2f;
  logic [23:0] c1_request, c2_request;
  logic [6:0] request_function;
  logic [7:0] request_slot, request_index, answer_length;
  assign stage = stage_i.c1 || stage_i.c2;
  assign request_function = staged_c2_q ? c2_request[6:0] : c1_request[6:0];
  assign request_slot = staged_c2_q ? c2_request[15:8] : c1_request[15:8];
  assign request_index = staged_c2_q ? c2_request[23:16] : c1_request[23:16];
  always_ff @(posedge clk_i) begin
    if (stage) staged_c2_q <= stage_i.c2;
    if (stage_i.acyclic_we && stage_i.index == 8'd0) begin
      error_q <= stage_i.data[7] && !`FAULT(93);
      function_same_q <= stage_i.data[6:0] == request_function;
    end
    if (stage_i.acyclic_we && stage_i.index == 8'd1) slot_same_q <= stage_i.data == request_slot;
    if (stage_i.acyclic_we && stage_i.index == 8'd2) index_same_q <= stage_i.data == request_index;
  end
  assign fits = function_same_q && (error_q || (slot_same_q && index_same_q) || `FAULT(92));
  assign c1_answer = answers_i.c1 && c1_with_user && fits;
  assign c2_answer = answers_i.c2 && c2_with_user && fits;
  assign answer_length = answers_i.length + 8'd4;

  // ---- the two of them
  logic c1_left, c1_allowed, c1_accept, c1_reply_user, c2_reply_user, reply_user, reply_long;
  logic [1:0] c2_accept, requester;
  logic [2:0] c1_reply, c2_reply, accept;
  logic [7:0] c1_reply_fc, c2_reply_fc, c1_reply_length, c2_reply_length, reply_s_length, reply_d_length;
  logic [31:0] c1_reply_head, c2_reply_head, reply_head;
  assign c1_left = left_i || init_i;
  assign c1_allowed = data_exch_i && from_holder_i && prm_dpv1_i;

  msac1 u_msac1 (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .left_i(c1_left), .answer_i(c1_answer), .answer_length_i(answer_length),
    .take_i(take_i.c1), .mail_o(c1_o.waits), .with_user_o(c1_with_user), .srd_i(c1_srd), .allowed_i(c1_allowed),
    .ssap_ok_i(ssap_51_q), .poll_i(poll), .code_i(c1_code), .head_i(head), .length_i(length_i), .accept_o(c1_accept),
    .request_o(c1_request), .length_o(c1_o.length), .reply_o(c1_reply), .reply_fc_o(c1_reply_fc),
    .reply_user_o(c1_reply_user), .reply_head_o(c1_reply_head), .reply_length_o(c1_reply_length));

  msac2 u_msac2 (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .init_i(init_i), .answer_i(c2_answer), .answer_length_i(answer_length),
    .take_i(take_i.c2), .mail_o(c2_o.waits), .with_user_o(c2_with_user), .owner_2f_o(owner_2f), .request_o(c2_request),
    .request_length_o(c2_o.length), .initiate_srd_i(initiate_srd), .channel_srd_i(channel_srd),
    .channel_sdn_i(channel_sdn), .dpv1_on_i(dpv1_on_i), .sa_i(sa_i[6:0]), .ssap_ok_i(ssap_50_q), .poll_i(poll),
    .abort_i(abort), .idle_i(idle), .again_i(initiate_again), .right_i(c2_right), .head_i(head), .length_i(length_i),
    .initiate_legal_i(initiate_legal), .timeout_i(timeout), .initiate_code_i(initiate_code), .long_i(long_form),
    .s_length_i(s_length), .d_length_i(d_length), .accept_o(c2_accept), .initiate_sap_i(initiate_sap_q),
    .channel_2f_i(c2f_sap_q), .reply_o(c2_reply), .reply_fc_o(c2_reply_fc), .reply_user_o(c2_reply_user),
    .reply_head_o(c2_reply_head), .reply_length_o(c2_reply_length), .reply_long_o(reply_long),
    .reply_s_length_o(reply_s_length), .reply_d_length_o(reply_d_length));

  assign accept = {c2_accept, c1_accept};
  assign requester = c1_sap_q ? MSAC_C1 : c2f_sap_q ? MSAC_2F : MSAC_30;
  assign replies_o = (service_i.srd || `FAULT(84)) && (c1_sap_q || initiate_sap_q || c30_sap_q || c2f_sap_q);
  assign reply_o.kind = c1_sap_q ? c1_reply : c2_reply;
  assign reply_o.fc = c1_sap_q ? c1_reply_fc : c2_reply_fc;
  assign reply_o.source = SRC_MSAC;
  assign reply_o.length = c1_sap_q ? c1_reply_length : c2_reply_length;
  assign reply_user = c1_sap_q ? c1_reply_user : c2_reply_user;
  assign reply_head = c1_sap_q ? c1_reply_head : c2_reply_head;
  assign c1_o.function_num = c1_request[7:0];
  assign c2_o.function_num = c2_request[7:0];

  logic stage_taken;
  assign stage_taken = stage_i.c2 ? c2_with_user : c1_with_user;
  msac_buffers u_buffers (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .data_valid_i(data_valid_i), .data_index_i(data_index_i), .data_i(data_i),
    .accept_i(accept), .take_c1_i(take_i.c1), .take_c2_i(take_i.c2), .owner_2f_i(owner_2f),
    .transfer_index_i(take_i.index), .transfer_data_o(mail_data_o), .stage_i(stage), .stage_taken_i(stage_taken),
    .stage_c2_i(stage_i.c2), .stage_we_i(stage_i.acyclic_we), .stage_index_i(stage_i.index), .stage_data_i(stage_i.data),
    .reply_i(service_i.execute), .requester_i(requester), .user_i(reply_user), .head_i(reply_head), .long_i(reply_long),
    .s_length_i(reply_s_length), .d_length_i(reply_d_length), .index_i(reply_index_i), .data_o(reply_data_o));
endmodule
