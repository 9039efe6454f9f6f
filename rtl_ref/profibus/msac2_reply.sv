// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The answer of a channel of MSAC_C2 to a telegram (15.2; V2, V10 to V12), by the state that the telegram finds.
`include "profibus_types.svh"

module msac2_reply (
  `FAULT_PORT
  input  channel_t    state_i,           // after the timers
  input  logic        served_i,          // the telegram is for this channel
  input  logic        poll_i,
  input  logic        abort_i,
  input  logic [1:0]  code_i,            // of the answer to Initiate
  input  logic [2:0]  reason_i,          // of the abort PDU
  input  logic        idle_i,            // what waits is the answer to Idle
  input  logic [7:0]  initiate_length_i,
  input  logic [7:0]  user_length_i,
  output logic [2:0]  reply_o,           // ANS_...
  output logic [7:0]  reply_fc_o,
  output logic        reply_user_o,      // the user's answer, else
  output logic [31:0] reply_head_o,      // these four bytes, the first lowest; longer: four of 00 and Add_Addr
  output logic [7:0]  reply_length_o
);
  logic initiate_right;
  assign initiate_right = code_i == MSAC_RIGHT;
  logic wrong_address;  // of Initiate
  logic [31:0] initiate_head;
  assign wrong_address = code_i == MSAC_INVALID_PARAMETER && !`FAULT(111);
  assign initiate_head = initiate_right ? {8'h00, 8'h01, 8'hF0, MSAC_INITIATE} : negative_answer(MSAC_INITIATE, code_i);

  always_comb begin
    reply_o = ANS_SC;
    reply_fc_o = FC_DL;
    reply_user_o = 1'b0;
    reply_head_o = abort_pdu(reason_i);
    reply_length_o = 8'd3;
    if (!served_i) begin
      reply_o = ANS_SD1;
      reply_fc_o = FC_RS;
    end else if (poll_i || !abort_i) begin
      case (state_i)
        C2_INITIATED: if (poll_i) begin
          reply_o = ANS_SD2;
          reply_head_o = wrong_address ? abort_pdu(ABORT_ADDRESS) : initiate_head;
          reply_length_o = initiate_right ? initiate_length_i : wrong_address ? 8'd3 : 8'd4;
        end
        C2_OPEN: ;
        C2_BUSY: if (!poll_i) begin
          reply_o = ANS_SD1;
          reply_fc_o = FC_RR;
        end
        C2_ANSWERED: begin
          reply_head_o = {24'd0, MSAC_IDLE};
          reply_user_o = !idle_i;
          reply_length_o = idle_i ? 8'd1 : user_length_i;
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
endmodule
