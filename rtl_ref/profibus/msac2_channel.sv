// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// A channel of MSAC_C2 (15.2; V2, V3, V8 to V13): its row of the RM registry, its state and its timers.
//
// At an edge: the user's answer, then the end of a timer, then the telegram: _q before the edge, _b after the timers, _d after
// the telegram. msac2_reply makes the answer of what the telegram finds.
`include "profibus_types.svh"

module msac2_channel (
  `FAULT_PORT
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        init_i,           // an initialisation is committed
  // the user
  input  logic        answer_i,         // the user's answer is accepted
  input  logic [7:0]  answer_length_i,  // bytes of the PDU
  input  logic        turn_i,           // the area becomes this channel's at this edge
  // Initiate
  input  logic        initiate_i,       // is answered with this channel, at this edge
  input  logic [15:0] timeout_i,        // Send_Timeout
  input  logic [1:0]  initiate_code_i,
  input  logic        long_i,
  input  logic [7:0]  s_length_i,
  input  logic [7:0]  d_length_i,
  // a telegram to the channel's SAP, executed at this edge
  input  logic        srd_i,
  input  logic        sdn_i,
  input  logic [6:0]  sa_i,
  input  logic        ssap_ok_i,
  input  logic        poll_i,
  input  logic        abort_i,
  input  logic        idle_i,
  input  logic        again_i,          // 57
  input  logic        right_i,          // a right request
  input  logic [23:0] head_i,           // Function_Num, slot, index; the first lowest
  input  logic [7:0]  length_i,
  output logic        accept_o,         // the telegram's bytes are the request
  // the answer to it
  output logic [2:0]  reply_o,          // ANS_...
  output logic [7:0]  reply_fc_o,
  output logic        reply_user_o,     // the user's answer, else
  output logic [31:0] reply_head_o,     // these four bytes, the first lowest; longer: four of 00 and Add_Addr
  output logic [7:0]  reply_length_o,
  // what it is
  output logic        free_o,           // after the timers
  output logic        busy_o,           // after the telegram
  output logic [23:0] request_o,
  output logic [7:0]  length_o,         // of what waits: the request, the user's answer, the answer to Initiate
  output logic        long_o,
  output logic [7:0]  s_length_o,
  output logic [7:0]  d_length_o,
  output logic [9:0]  registry_o        // table 30: master address, in use, connected, exchanging
);
  channel_t state_q, state_b, state_d;
  logic [1:0] code_q;                        // of the answer to Initiate
  logic [2:0] reason_q, reason_b, reason_d;  // of the abort PDU
  logic idle_q;                              // what waits is the answer to Idle
  logic [7:0] length_q, length_b;
  logic [15:0] timeout_q;

  // ---- timers
  logic watch_start, watch_stop, watch_end, watch_i_q, aborts, user_stop, user_end, watch_late, user_late;
  logic [15:0] twice, watch_units;
  assign twice = (timeout_q[15] && !`FAULT(82)) ? 16'hFFFF : {timeout_q[14:0], 1'b0};
  assign watch_units = watch_i_q && !`FAULT(81) ? twice : timeout_q;
  assign watch_late = watch_i_q ? `FAULT(79) : `FAULT(78);
  assign user_late = `FAULT(80);
  msac2_timer u_watch (
`ifdef SINGLE_FAULTS
    `FAULT_CONNECT
`endif
    .clk_i(clk_i), .rst_ni(rst_ni), .start_i(watch_start), .stop_i(watch_stop), .units_i(watch_units), .late_i(watch_late),
    .end_o(watch_end));
  msac2_timer u_user (
`ifdef SINGLE_FAULTS
    `FAULT_CONNECT
`endif
    .clk_i(clk_i), .rst_ni(rst_ni), .start_i(turn_i), .stop_i(user_stop), .units_i(timeout_q), .late_i(user_late),
    .end_o(user_end));

  always_comb begin
    state_b = state_q;
    reason_b = reason_q;
    if (answer_i) state_b = C2_ANSWERED;
    aborts = 1'b0;
    if (watch_end && state_q == C2_ABORTED) begin
      if (!`FAULT(94)) state_b = C2_FREE;
    end else if (watch_end) begin
      state_b = C2_ABORTED;
      reason_b = ABORT_TIMEOUT;
      aborts = 1'b1;
    end else if (user_end && !answer_i) begin
      state_b = C2_ABORTED;
      reason_b = `FAULT(85) ? ABORT_SEQUENCE : ABORT_TIMEOUT;
      aborts = 1'b1;
    end
  end
  assign length_b = answer_i ? answer_length_i : length_q;

  // ---- the telegram
  logic from_master_q, served, requests, polls, ends, asks;
  assign served = state_b != C2_FREE && (from_master_q || `FAULT(87)) && (ssap_ok_i || `FAULT(75));
  assign requests = served && srd_i && !poll_i && !abort_i;
  assign polls = served && srd_i && poll_i;
  assign ends = served && !poll_i && abort_i && (srd_i || sdn_i);
  assign asks = requests && state_b == C2_OPEN;
  assign accept_o = asks && right_i;

  // Its state. In OPEN a request is for the user, Idle, or wrong
  channel_t asked;
  logic initiate_right, starts;
  assign initiate_right = code_q == MSAC_RIGHT;
  always_comb begin
    if (right_i) asked = C2_BUSY;
    else if (idle_i) asked = C2_ANSWERED;
    else asked = C2_ABORTED;
  end
  always_comb begin
    state_d = state_b;
    if (initiate_i) state_d = C2_INITIATED;
    else if (ends) state_d = C2_FREE;
    else begin
      case (state_b)
        C2_INITIATED: begin
          if (polls && initiate_right) state_d = C2_OPEN;
          else if (polls || (requests && `FAULT(126))) state_d = C2_FREE;
          else if (requests) state_d = C2_ABORTED;
        end
        C2_OPEN: if (requests) state_d = asked;
        C2_BUSY: ;
        C2_ANSWERED: if (polls) state_d = C2_OPEN;
        default: if (polls || requests) state_d = C2_FREE;
      endcase
    end
    if (init_i) state_d = C2_FREE;
  end

  // Why it is aborted
  always_comb begin
    reason_d = reason_b;
    if (requests && !initiate_i && state_b == C2_INITIATED) reason_d = ABORT_SEQUENCE;
    if (requests && !initiate_i && state_b == C2_OPEN) reason_d = again_i && !`FAULT(127) ? ABORT_SEQUENCE : ABORT_INVALID_PDU;
  end

  // Start of F or I
  always_comb begin
    starts = aborts;
    if (initiate_i) starts = 1'b1;
    else if (!ends) begin
      case (state_b)
        C2_INITIATED: if (polls || requests) starts = 1'b1;
        C2_OPEN: if (requests) starts = !(`FAULT(128) && asked == C2_ABORTED);
        C2_BUSY: if (polls && !`FAULT(83)) starts = 1'b1;
        C2_ANSWERED: if (polls && !`FAULT(172)) starts = 1'b1;
        default: ;
      endcase
    end
  end
  assign watch_stop = state_d == C2_FREE;
  assign watch_start = starts && !watch_stop;
  assign user_stop =
`ifdef SINGLE_FAULTS
      `FAULT(196) ? state_d == C2_FREE || state_d == C2_ABORTED :
`endif
      state_d != C2_BUSY;

  // ---- the answer
  msac2_reply u_reply (
    `FAULT_CONNECT
    .state_i(state_b), .served_i(served), .poll_i(poll_i), .abort_i(abort_i), .code_i(code_q), .reason_i(reason_b), .idle_i(idle_q),
    .initiate_length_i(length_q), .user_length_i(length_b), .reply_o(reply_o), .reply_fc_o(reply_fc_o), .reply_user_o(reply_user_o),
    .reply_head_o(reply_head_o), .reply_length_o(reply_length_o));

  // ---- registers: the state
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= C2_FREE;
      reason_q <= 3'd0;
      watch_i_q <= 1'b0;
    end else begin
      state_q <= state_d;
      reason_q <= reason_d;
      if (watch_start) watch_i_q <= state_d == C2_OPEN;
    end
  end

  // ... the master, from Initiate
  logic long_q;
  logic [6:0] master_q;
  logic [7:0] s_length_q, d_length_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      from_master_q <= 1'b0;
      code_q <= 2'd0;
      long_q <= 1'b0;
      master_q <= 7'd0;
      {s_length_q, d_length_q} <= 16'd0;
      timeout_q <= 16'd0;
    end else begin
      from_master_q <= sa_i == master_q;
      if (initiate_i) begin
        master_q <= sa_i;
        timeout_q <= timeout_i;
        code_q <= initiate_code_i;
        long_q <= long_i;
        s_length_q <= s_length_i;
        d_length_q <= d_length_i;
      end
    end
  end

  // ... what waits. The answer to Initiate has four bytes in front of Add_Addr less than Initiate
  logic [23:0] request_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      idle_q <= 1'b0;
      length_q <= 8'd0;
      request_q <= 24'd0;
    end else if (initiate_i) begin
      length_q <= length_i - 8'd4;
    end else if (asks) begin
      request_q <= head_i;
      idle_q <= idle_i;
      length_q <= length_i;
    end else begin
      length_q <= length_b;
    end
  end

  logic in_use, connected, exchanging;
  assign in_use = state_q != C2_FREE;
  assign exchanging = state_q == C2_BUSY || state_q == C2_ANSWERED;
  assign connected = state_q == C2_OPEN || exchanging;
  assign registry_o = {master_q, in_use, connected, exchanging};

  assign free_o = state_b == C2_FREE;
  assign busy_o = state_d == C2_BUSY;
  assign request_o = request_q;
  assign length_o = length_q;
  assign long_o = long_q;
  assign s_length_o = s_length_q;
  assign d_length_o = d_length_q;
endmodule
