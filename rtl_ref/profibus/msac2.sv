// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// MSAC_C2 (15.2; V2 to V13): Initiate on SAP 49, the two channels on SAPs 48 and 47, and whose turn it is with the user.
//
// In vectors of two bits, bit 0 is the channel of SAP 48 (30), bit 1 that of SAP 47 (2F).
`include "profibus_types.svh"

module msac2 (
  `FAULT_PORT
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        init_i,           // an initialisation is committed
  // the user's answer
  input  logic        answer_i,         // is committed, fits the request and has a right CRC
  input  logic [7:0]  answer_length_i,  // bytes of the PDU
  input  logic        take_i,           // the user's side takes the mail
  output logic        mail_o,
  output logic        with_user_o,
  output logic        owner_2f_o,       // the channel that the request with the user, or on its way there, is of
  output logic [23:0] request_o,
  output logic [7:0]  request_length_o,
  // the telegram, executed at this edge
  input  logic        initiate_srd_i,   // an SRD to SAP 49
  input  logic [1:0]  channel_srd_i,    // an SRD to a channel
  input  logic [1:0]  channel_sdn_i,
  input  logic        dpv1_on_i,        // D17
  input  logic [6:0]  sa_i,
  input  logic        ssap_ok_i,
  input  logic        poll_i,
  input  logic        abort_i,
  input  logic        idle_i,
  input  logic        again_i,          // 57 on a channel
  input  logic        right_i,          // a right request
  input  logic [23:0] head_i,           // Function_Num, slot, index; the first lowest
  input  logic [7:0]  length_i,
  input  logic        initiate_legal_i,
  input  logic [15:0] timeout_i,
  input  logic [1:0]  initiate_code_i,
  input  logic        long_i,
  input  logic [7:0]  s_length_i,
  input  logic [7:0]  d_length_i,
  output logic [1:0]  accept_o,         // the telegram's bytes are a channel's Initiate or request
  // the answer to it
  input  logic        initiate_sap_i,   // the telegram is to SAP 49
  input  logic        channel_2f_i,     // else to this channel
  output logic [2:0]  reply_o,          // ANS_...
  output logic [7:0]  reply_fc_o,
  output logic        reply_user_o,     // the user's answer
  output logic [31:0] reply_head_o,     // the first four bytes, the first lowest
  output logic [7:0]  reply_length_o,
  output logic        reply_long_o,     // form of Add_Addr
  output logic [7:0]  reply_s_length_o,
  output logic [7:0]  reply_d_length_o
);
  logic [1:0] initiate, answer, accept, reply_user, is_free, busy, long_form, turn;
  logic [1:0] owner_q, owner_d;  // of the area; no bit: no one
  logic mail_q, taken_q;
  logic [5:0] reply;
  logic [15:0] reply_fc, reply_length, length, s_length, d_length;
  logic [47:0] request;
  logic [63:0] reply_head;
  logic [19:0] registry;

  genvar n;
  generate
    for (n = 0; n < 2; n = n + 1) begin : g_channel
      msac2_channel u_channel (
        `FAULT_CONNECT
        .clk_i(clk_i), .rst_ni(rst_ni), .init_i(init_i), .answer_i(answer[n]), .answer_length_i(answer_length_i),
        .turn_i(turn[n]), .initiate_i(initiate[n]), .timeout_i(timeout_i), .initiate_code_i(initiate_code_i),
        .long_i(long_i), .s_length_i(s_length_i), .d_length_i(d_length_i), .srd_i(channel_srd_i[n]),
        .sdn_i(channel_sdn_i[n]), .sa_i(sa_i), .ssap_ok_i(ssap_ok_i), .poll_i(poll_i), .abort_i(abort_i), .idle_i(idle_i),
        .again_i(again_i), .right_i(right_i), .head_i(head_i), .length_i(length_i), .accept_o(accept[n]), .reply_o(reply[n*3+:3]),
        .reply_fc_o(reply_fc[n*8+:8]), .reply_user_o(reply_user[n]),
        .reply_head_o(reply_head[n*32+:32]), .reply_length_o(reply_length[n*8+:8]), .free_o(is_free[n]), .busy_o(busy[n]),
        .request_o(request[n*24+:24]), .length_o(length[n*8+:8]), .long_o(long_form[n]), .s_length_o(s_length[n*8+:8]),
        .d_length_o(d_length[n*8+:8]), .registry_o(registry[n*10+:10]));
    end
  endgenerate

  // The RM registry (table 30, 15.3), for waves: master address, SAP, in use, connected, exchanging
  /* verilator lint_off UNUSEDSIGNAL */  // for waves alone
  logic [17:0] rm_30, rm_2f;
  /* verilator lint_on UNUSEDSIGNAL */
  assign rm_30 = {registry[9:3], SAP_MSAC_30, registry[2:0]};
  assign rm_2f = {registry[19:13], SAP_MSAC_2F, registry[12:10]};

  // ---- Initiate: the first free row of the registry
  logic may_initiate, initiate_ok, takes_2f;
  assign may_initiate = dpv1_on_i && ssap_ok_i;
  assign takes_2f = `FAULT(74) ? is_free[1] : !is_free[0];
  assign initiate_ok = may_initiate && !poll_i && initiate_legal_i && is_free != 2'b00;
  assign initiate = initiate_srd_i && initiate_ok ? {takes_2f, !takes_2f} : 2'b00;
  assign accept_o = accept | initiate;

  // ---- whose turn it is
  logic leaves;
  assign leaves = (owner_q & busy) == 2'b00 || owner_q == 2'b11;  // never both
  assign owner_d = !leaves ? owner_q : `FAULT(76) && owner_q != 2'b00 ? 2'b00 : busy[0] ? 2'b01 : busy[1] ? 2'b10 : 2'b00;
  assign turn = `FAULT(77) ? accept & busy : owner_d & ~owner_q;
  assign answer = answer_i ? owner_q : 2'b00;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      owner_q <= 2'b00;
      {mail_q, taken_q} <= 2'b00;
    end else begin
      owner_q <= owner_d;
      mail_q <= leaves ? owner_d != 2'b00 : mail_q && !take_i;
      taken_q <= !leaves && (taken_q || take_i);
    end
  end
  assign mail_o = mail_q;
  assign with_user_o = taken_q;
  assign owner_2f_o = owner_q[1];
  assign request_o = owner_q[1] ? request[47:24] : request[23:0];
  assign request_length_o = owner_q[1] ? length[15:8] : length[7:0];

  // ---- the answer
  logic [2:0] initiate_reply;
  assign initiate_reply = may_initiate && poll_i ? ANS_SC : initiate_ok ? ANS_SD2 : ANS_SD1;
  assign reply_o = initiate_sap_i ? initiate_reply : channel_2f_i ? reply[5:3] : reply[2:0];
  assign reply_fc_o = initiate_sap_i ? (initiate_ok ? FC_DL : FC_RS) : channel_2f_i ? reply_fc[15:8] : reply_fc[7:0];
  assign reply_user_o = !initiate_sap_i && (channel_2f_i ? reply_user[1] : reply_user[0]);
  assign reply_head_o = initiate_sap_i ? {timeout_i[7:0], timeout_i[15:8], takes_2f ? SAP_MSAC_2F : SAP_MSAC_30, MSAC_IMMEDIATE} :
                        channel_2f_i ? reply_head[63:32] : reply_head[31:0];
  assign reply_length_o = initiate_sap_i ? 8'd4 : channel_2f_i ? reply_length[15:8] : reply_length[7:0];
  assign reply_long_o = channel_2f_i ? long_form[1] : long_form[0];
  assign reply_s_length_o = channel_2f_i ? s_length[15:8] : s_length[7:0];
  assign reply_d_length_o = channel_2f_i ? d_length[15:8] : d_length[7:0];
endmodule
