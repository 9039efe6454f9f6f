// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Sends the answer (8.3; P2, S3, S11): waits until T, then PBRTS and the characters without a gap.
`include "profibus_types.svh"

module uart_tx (
  `FAULT_PORT
  input  logic [5:0]  rts_lead_i,     // 0 to 32: PBRTS has to rise after the decision at every rate
  input  logic [5:0]  rts_trail_i,    // 0 to 32
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        abort_i,        // initialisation
  input  logic        send_i,         // an answer, to the telegram decided at this edge
  input  logic [3:0]  rate_i,
  input  logic [7:0]  min_tsdr_i,     // at the edge after the decision
  input  logic [5:0]  clock_bits_i,   // of uart_rx, as of this edge
  input  logic [12:0] clock_phase_i,
  output logic [7:0]  index_o,
  input  logic [7:0]  data_i,
  input  logic [7:0]  length_i,       // characters
  output logic        risen_o,        // PBRTS rose at the last edge
  output logic        fall_o,         // PBRTS falls at this edge, at the end of an answer
  output logic        pbtxd_o,
  output logic        pbrts_o
);
  typedef enum logic [2:0] {
    IDLE = 3'd0,
    WAIT = 3'd1,
    LEAD = 3'd2,
    SEND = 3'd3,
    TRAIL = 3'd4
  } state_t;

  logic [2:0] state_q;
  logic fresh_q;  // the edge after the decision
  logic [3:0] rate_q;
  logic [7:0] tsdr_q, tsdr_now, tsdr_limit;
  logic [8:0] bits_q;
  logic [12:0] phase_q, phase_last;
  logic [9:0] count_q;
  logic [9:0] shift_q;
  logic [3:0] bit_q;
  logic [7:0] index_q;
  logic txd_q, rts_q, risen_q;

  // Without lead or trail their states are not entered
  logic no_lead, no_trail;
  assign no_lead = rts_lead_i == 6'd0;
  assign no_trail = rts_trail_i == 6'd0;

  assign phase_last = bit_cycles(rate_q) - 13'd1;
  assign tsdr_limit =
`ifdef SINGLE_FAULTS
      (`FAULT(177) && rate_q == 4'd4 ? 8'd1 : 8'd0) +
`endif
      max_tsdr(rate_q);
  assign tsdr_now = !fresh_q ? tsdr_q : min_tsdr_i > tsdr_limit && !`FAULT(43) ? tsdr_limit : min_tsdr_i;

  logic time_comes, rises, character_starts, bit_ends, all_sent, parity;
  assign time_comes = state_q == WAIT && bits_q >= {1'b0, tsdr_now};
  assign rises = time_comes && !send_i;
  assign bit_ends = phase_q == 13'd0;
  assign character_starts = (state_q == LEAD && count_q == 10'd0) || (rises && no_lead) ||
                            (state_q == SEND && bit_ends && bit_q == 4'd10 && index_q != length_i);
  assign all_sent = state_q == SEND && bit_ends && bit_q == 4'd10 && index_q == length_i;
  // No such state after TRAIL, and no PBRTS before LEAD: it ends there and then
  assign fall_o = !abort_i && ((all_sent && no_trail) || (state_q == TRAIL && count_q == 10'd0) || state_q > TRAIL || (rts_q && state_q < LEAD));
  assign parity = ^data_i ^ `FAULT(44);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= IDLE;
      fresh_q <= 1'b0;
      risen_q <= 1'b0;
      rate_q <= 4'd0;
      tsdr_q <= 8'd0;
      bits_q <= 9'd0;
      phase_q <= 13'd0;
      count_q <= 10'd0;
      shift_q <= 10'h3FF;
      bit_q <= 4'd0;
      index_q <= 8'd0;
      txd_q <= 1'b1;
      rts_q <= 1'b0;
    end else if (abort_i) begin
      state_q <= IDLE;
      risen_q <= 1'b0;
      txd_q <= 1'b1;
      rts_q <= 1'b0;
`ifdef SINGLE_FAULTS
      if (`FAULT(200)) txd_q <= txd_q;
`endif
    end else begin
      fresh_q <= send_i;
      risen_q <= rises;
      tsdr_q <= tsdr_now;
      count_q <= count_q - 10'd1;
      phase_q <= bit_ends ? phase_last : phase_q - 13'd1;
      if (bit_ends) bits_q <= bits_q + 9'd1;

      if (send_i) begin
        state_q <= WAIT;
        rate_q <= rate_i;
        index_q <= 8'd0;
        bits_q <= clock_phase_i == 13'd0 ? {3'd0, clock_bits_i} + 9'd1 : {3'd0, clock_bits_i};
        phase_q <= clock_phase_i == 13'd0 ? bit_cycles(rate_i) - 13'd1 : clock_phase_i - 13'd1;
      end else if (rises) begin
        state_q <= LEAD;
        count_q <= {4'd0, rts_lead_i} - 10'd1;
        rts_q <= 1'b1;
      end

      if (character_starts) begin
        state_q <= SEND;
        phase_q <= phase_last;
        bit_q <= 4'd0;
        index_q <= index_q + 8'd1;
        shift_q <= {1'b1, parity, data_i};
        txd_q <= 1'b0;
      end else if (all_sent) begin
        state_q <= TRAIL;
        count_q <= {4'd0, rts_trail_i} - 10'd1;
      end else if (state_q == SEND && bit_ends) begin
        bit_q <= bit_q + 4'd1;
        shift_q <= {1'b1, shift_q[9:1]};
        txd_q <= shift_q[0];
      end

      if (fall_o) begin
        state_q <= IDLE;
        txd_q <= 1'b1;
        rts_q <= 1'b0;
      end
    end
  end

  assign risen_o = risen_q;
  assign index_o = index_q;
  assign pbtxd_o = txd_q;
  assign pbrts_o = rts_q;
endmodule
