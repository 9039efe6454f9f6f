// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// A channel of MSAC_C2 (15.2; V2, V3, V8 to V13): its row of the RM registry, its state and its timers.
//
// At an edge: the user's answer, then the end of a timer, then the telegram: _q before the edge, _b after the timers, _d after
// the telegram.
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
  localparam logic [2:0] FREE = 3'd0;
  localparam logic [2:0] INITIATED = 3'd1;
  localparam logic [2:0] OPEN = 3'd2;
  localparam logic [2:0] BUSY = 3'd3;
  localparam logic [2:0] ANSWERED = 3'd4;
  localparam logic [2:0] ABORTED = 3'd5;

  logic [2:0] state_q, state_b, state_d;
  logic [1:0] code_q;
  logic [2:0] reason_q, reason_b, reason_d;  // of the abort PDU
  logic idle_q, long_q, from_master_q;
  logic [6:0] master_q;
  logic [7:0] length_q, length_b, s_length_q, d_length_q;
  logic [15:0] timeout_q;
  logic [23:0] request_q;

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
    state_b = answer_i ? ANSWERED : state_q;
    reason_b = reason_q;
    aborts = 1'b0;
    if (watch_end && state_q == ABORTED) begin
      if (!`FAULT(94)) state_b = FREE;
    end else if (watch_end) begin
      state_b = ABORTED;
      reason_b = ABORT_TIMEOUT;
      aborts = 1'b1;
    end else if (user_end && !answer_i) begin
      state_b = ABORTED;
      reason_b = `FAULT(85) ? ABORT_SEQUENCE : ABORT_TIMEOUT;
      aborts = 1'b1;
    end
  end
  assign length_b = answer_i ? answer_length_i : length_q;

  // ---- the telegram
  logic served, initiate_right, asks, starts;
  assign served = state_b != FREE && (from_master_q || `FAULT(87)) && (ssap_ok_i || `FAULT(75));
  assign initiate_right = code_q == MSAC_RIGHT;
  assign asks = srd_i && served && state_b == OPEN && !poll_i && !abort_i;
  assign accept_o = asks && right_i;

  always_comb begin
    state_d = state_b;
    reason_d = reason_b;
    starts = aborts;
    if (initiate_i) begin
      state_d = INITIATED;
      starts = 1'b1;
    end else if (served && !poll_i && abort_i && (srd_i || sdn_i)) begin
      state_d = FREE;
    end else if (served && srd_i) begin
      case (state_b)
        INITIATED: begin
          if (!poll_i) begin
            state_d = `FAULT(126) ? FREE : ABORTED;
            reason_d = ABORT_SEQUENCE;
          end else begin
            state_d = initiate_right ? OPEN : FREE;
          end
          starts = 1'b1;
        end
        OPEN: if (!poll_i) begin
          state_d = accept_o ? BUSY : idle_i ? ANSWERED : ABORTED;
          reason_d = again_i && !`FAULT(127) ? ABORT_SEQUENCE : ABORT_INVALID_PDU;
          starts = !(state_d == ABORTED && `FAULT(128));
        end
        BUSY: if (poll_i && !`FAULT(83)) starts = 1'b1;
        ANSWERED: if (poll_i) begin
          state_d = OPEN;
          starts = 1'b1;
`ifdef SINGLE_FAULTS
          if (`FAULT(172)) starts = aborts;
`endif
        end
        default: state_d = FREE;
      endcase
    end
    if (init_i) state_d = FREE;
  end
  assign watch_stop = state_d == FREE;
  assign watch_start = starts && !watch_stop;
  assign user_stop =
`ifdef SINGLE_FAULTS
      `FAULT(196) ? state_d == FREE || state_d == ABORTED :
`endif
      state_d != BUSY;

  // ---- the answer
  logic wrong_address;  // of Initiate
  logic [31:0] initiate_head;
  assign wrong_address = code_q == MSAC_INVALID_PARAMETER && !`FAULT(111);
  assign initiate_head = initiate_right ? {8'h00, 8'h01, 8'hF0, MSAC_INITIATE} : negative_answer(MSAC_INITIATE, code_q);

  always_comb begin
    reply_o = ANS_SC;
    reply_fc_o = FC_DL;
    reply_user_o = 1'b0;
    reply_head_o = abort_pdu(reason_b);
    reply_length_o = 8'd3;
    if (!served) begin
      reply_o = ANS_SD1;
      reply_fc_o = FC_RS;
    end else if (poll_i || !abort_i) begin
      case (state_b)
        INITIATED: if (poll_i) begin
          reply_o = ANS_SD2;
          reply_head_o = wrong_address ? abort_pdu(ABORT_ADDRESS) : initiate_head;
          reply_length_o = initiate_right ? length_q : wrong_address ? 8'd3 : 8'd4;
        end
        OPEN: ;
        BUSY: if (!poll_i) begin
          reply_o = ANS_SD1;
          reply_fc_o = FC_RR;
        end
        ANSWERED: begin
          reply_head_o = {24'd0, MSAC_IDLE};
          reply_user_o = !idle_q;
          reply_length_o = idle_q ? 8'd1 : length_b;
          if (poll_i) begin
            reply_o = ANS_SD2;
          end else if (!`FAULT(86)) begin
            reply_o = ANS_SD1;
            reply_fc_o = FC_RR;
          end
        end
        default: reply_o = ANS_SD2;
      endcase
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= FREE;
      {reason_q, code_q} <= 5'd0;
      {idle_q, long_q, from_master_q, watch_i_q} <= 4'd0;
      master_q <= 7'd0;
      {length_q, s_length_q, d_length_q} <= 24'd0;
      timeout_q <= 16'd0;
      request_q <= 24'd0;
    end else begin
      state_q <= state_d;
      reason_q <= reason_d;
      from_master_q <= sa_i == master_q;
      length_q <= length_b;
      if (watch_start) watch_i_q <= state_d == OPEN;
      if (initiate_i) begin
        master_q <= sa_i;
        timeout_q <= timeout_i;
        code_q <= initiate_code_i;
        long_q <= long_i;
        s_length_q <= s_length_i;
        d_length_q <= d_length_i;
        length_q <= length_i - 8'd4;  // four bytes in front of Add_Addr less than Initiate
      end else if (asks) begin
        request_q <= head_i;
        idle_q <= idle_i;
        length_q <= length_i;
      end
    end
  end

  logic in_use, connected, exchanging;
  assign in_use = state_q != FREE;
  assign exchanging = state_q == BUSY || state_q == ANSWERED;
  assign connected = state_q == OPEN || exchanging;
  assign registry_o = {master_q, in_use, connected, exchanging};

  assign free_o = state_b == FREE;
  assign busy_o = state_d == BUSY;
  assign request_o = request_q;
  assign length_o = length_q;
  assign long_o = long_q;
  assign s_length_o = s_length_q;
  assign d_length_o = d_length_q;
endmodule
