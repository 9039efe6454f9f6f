// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// MSAC_C1 (15.1; V1, V7 to V9, V14): one request at a time, from the holding master.
//
// At an edge: the user's answer, then the telegram, then DATA_EXCH being left by whatever happened at it.
`include "profibus_types.svh"

module msac1 (
  `FAULT_PORT
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        left_i,         // DATA_EXCH is left at this edge, or an initialisation is committed
  // the user's answer
  input  logic        answer_i,       // is committed, fits the request and has a right CRC
  input  logic [7:0]  answer_length_i,  // bytes of the PDU
  input  logic        take_i,         // the user's side takes the mail
  output logic        mail_o,
  output logic        with_user_o,
  // the telegram
  input  logic        srd_i,          // an SRD to SAP 51 is executed at this edge
  input  logic        allowed_i,      // DATA_EXCH, the holder, DPV1_Enable
  input  logic        ssap_ok_i,
  input  logic        poll_i,
  input  logic [1:0]  code_i,         // MSAC_..., of a request
  input  logic [23:0] head_i,         // Function_Num, slot, index; the first lowest
  input  logic [7:0]  length_i,
  output logic        accept_o,       // the telegram's bytes are the request
  output logic [23:0] request_o,
  output logic [7:0]  length_o,       // of what waits: the request, or the user's answer
  // the answer to the telegram
  output logic [2:0]  reply_o,        // ANS_...
  output logic [7:0]  reply_fc_o,
  output logic        reply_user_o,   // the user's answer, else
  output logic [31:0] reply_head_o,   // these four bytes, the first lowest
  output logic [7:0]  reply_length_o
);
  typedef enum logic [1:0] {
    IDLE = 2'd0,
    OPEN = 2'd1,
    ANSWERED = 2'd2
  } state_t;

  logic [1:0] state_q, state_b, state_d, code_q;
  logic mail_q, taken_q, served, asks, polls;
  logic [23:0] request_q;
  logic [7:0] length_q, length_b;
  assign state_b = answer_i ? ANSWERED : state_q;
  assign length_b = answer_i ? answer_length_i : length_q;
  assign served = allowed_i && (ssap_ok_i || `FAULT(63));
  assign polls = srd_i && served && poll_i;
  assign asks = srd_i && served && !poll_i && state_b == IDLE;
  assign accept_o = asks && code_i == MSAC_RIGHT;

  always_comb begin
    state_d = state_b;
    if (asks) state_d = code_i == MSAC_RIGHT ? OPEN : ANSWERED;
    if (polls && state_b == ANSWERED && !`FAULT(66)) state_d = IDLE;
    if ((left_i && !`FAULT(65)) || state_q > ANSWERED) state_d = IDLE;  // 3: no such state
  end

  logic refused_busy;
  assign refused_busy = !poll_i && state_b != IDLE && !`FAULT(64);
  always_comb begin
    reply_o = ANS_SC;
    reply_fc_o = FC_DL;
    if (!served) begin
      reply_o = ANS_SD1;
      reply_fc_o = FC_RS;
    end else if (refused_busy) begin
      reply_o = ANS_SD1;
      reply_fc_o = FC_RR;
    end else if (poll_i && state_b == ANSWERED) begin
      reply_o = ANS_SD2;
    end
  end
  assign reply_user_o = code_q == MSAC_RIGHT;
  assign reply_head_o = negative_answer(request_q[7:0], code_q);
  assign reply_length_o = reply_user_o ? length_b : 8'd4;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= IDLE;
      {mail_q, taken_q} <= 2'b00;
      code_q <= MSAC_RIGHT;
      request_q <= 24'd0;
      length_q <= 8'd0;
    end else begin
      state_q <= state_d;
      mail_q <= state_d == OPEN && (accept_o || (mail_q && !take_i));
`ifdef SINGLE_FAULTS
      if (`FAULT(194) && state_d == IDLE) mail_q <= mail_q && !take_i;
`endif
      taken_q <= state_d == OPEN && !accept_o && (taken_q || take_i);
      length_q <= asks ? length_i : length_b;
      if (asks) begin
        request_q <= head_i;
        code_q <= code_i;
      end
    end
  end

  assign mail_o = mail_q;
  assign with_user_o = taken_q;
  assign request_o = request_q;
  assign length_o = length_q;
endmodule
