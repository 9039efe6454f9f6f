// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The UART port (6.1, 6.2, 6.5; UA1 to UA4, UA16): characters to and from the host, half duplex, and the two waits that begin with a
// character's end: for the silence that ends a telegram, and for the first start bit of the reply.
`include "dsdpv1_rsu_types.svh"

module host_uart (
  `FAULT_PORT
  /* verilator lint_off UNUSEDSIGNAL */  // the upper bits of each
  input  logic [127:0] gaps_i,      // UA3: half characters by code, 16 bits each, code 0 lowest; 1 to 1000
  /* verilator lint_on UNUSEDSIGNAL */
  input  logic [7:0]   min_tsdr_i,  // UA4: bit times
  input  logic         clk_i,
  input  logic         rst_ni,
  input  logic         on_i,        // the mode is UART
  input  logic         begins_i,    // edge R
  input  logic [2:0]   ubr_i,
  input  logic [2:0]   uiv_i,
  input  logic         rxd_i,
  output logic         txd_o,
  input  logic [2:0]   interval_i,  // B019, 0 unless it is a code
  input  logic [7:0]   tsdr_i,      // B01A
  // at this edge
  output logic         take_o,      // a right character
  output logic         spoil_o,     // a wrong one
  output logic         silence_o,
  output logic [7:0]   byte_o,
  input  logic         waits_i,     // the telegram waits for its first character
  input  logic         last_i,      // this one is the last of a telegram for this card
  // reply
  input  logic         judged_i,    // a telegram that is replied to, at this edge
  input  logic         busy_i,      // its commit was not done before this edge
  output logic         next_o,      // a character begins at this edge
  input  logic [7:0]   byte_i,
  input  logic         more_i
);
  // Cycles of a bit (UA1), of its half and of the rest, less a number: tables for a synthesis
  function automatic logic [12:0] bit_less(input logic [2:0] rate, input logic [12:0] less);
    case (rate)
      3'd0: bit_less = 13'd5000 - less;
      3'd1: bit_less = 13'd2500 - less;
      3'd2: bit_less = 13'd1250 - less;
      3'd3: bit_less = 13'd833 - less;
      3'd4: bit_less = 13'd417 - less;
      3'd5: bit_less = 13'd208 - less;
      3'd6: bit_less = 13'd104 - less;
      default: bit_less = 13'd26 - less;
    endcase
  endfunction

  function automatic logic [12:0] half_less(input logic [2:0] rate, input logic [12:0] less);
    case (rate)
      3'd0: half_less = 13'd2500 - less;
      3'd1: half_less = 13'd1250 - less;
      3'd2: half_less = 13'd625 - less;
      3'd3: half_less = 13'd416 - less;
      3'd4: half_less = 13'd208 - less;
      3'd5: half_less = 13'd104 - less;
      3'd6: half_less = 13'd52 - less;
      default: half_less = 13'd13 - less;
    endcase
  endfunction

  function automatic logic [12:0] rest_less(input logic [2:0] rate, input logic [12:0] less);
    case (rate)
      3'd3: rest_less = 13'd417 - less;
      3'd4: rest_less = 13'd209 - less;
      default: rest_less = half_less(rate, less);
    endcase
  endfunction

  // Half characters: whole bit times and, for an odd number, half a bit besides
  function automatic logic [13:0] wait_of(input logic [9:0] halves);
    wait_of = {halves[0], {4'd0, halves[9:1]} * 13'd11 + (halves[0] ? 13'd5 : 13'd0)};
  endfunction

  logic [12:0] bit_last;
  assign bit_last = bit_less(ubr_i, 13'd1);
  logic rxd;
  synchroniser #(.POWER_ON(1'b1)) u_rxd (.clk_i(clk_i), .d_i(rxd_i), .q_o(rxd));

  // ---- receiver
  typedef enum logic [1:0] {
    IDLE = 2'd0,
    RECEIVING = 2'd1,
    BREAK = 2'd2
  } state_t;
  logic [1:0] state_q, state_d;
  logic [12:0] timer_q;
  logic [3:0] sample_q;  // of the next sample: 0 start bit, 1..8 data, 9 parity, 10 stop
  logic [8:0] shift_q;
  logic odd_q, answers_q, run, starts, samples, glitch, complete, break_ends, restarts, all_sent;
  assign run = on_i && (!answers_q || `FAULT(150));
  assign restarts = (on_i && begins_i) || all_sent;
  assign starts = run && state_q == IDLE && !rxd;
  assign samples = run && state_q == RECEIVING && timer_q == 13'd0;
  assign glitch = samples && sample_q == 4'd0 && rxd;
  assign complete = samples && sample_q == 4'd10;
  assign break_ends = run && state_q == BREAK && rxd;
  always_comb begin
    state_d = state_q >= BREAK ? BREAK : state_q;  // 3: no such state
    if (starts) state_d = RECEIVING;
    else if (glitch || break_ends) state_d = IDLE;
    else if (complete) state_d = rxd ? IDLE : BREAK;
    if (restarts) state_d = rxd ? IDLE : BREAK;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= IDLE;
      timer_q <= 13'd0;
      sample_q <= 4'd0;
      shift_q <= 9'd0;
      odd_q <= 1'b0;
    end else begin
      state_q <= state_d;
      timer_q <= starts ? half_less(ubr_i, 13'd1) : samples ? bit_last : timer_q - 13'd1;
      if (starts) begin
        sample_q <= 4'd0;
        odd_q <= 1'b0;
      end else if (samples) begin
        sample_q <= sample_q + 4'd1;
        if (sample_q != 4'd0 && !complete) begin
          shift_q <= {rxd, shift_q[8:1]};
          odd_q <= odd_q ^ rxd;
        end
      end
    end
  end
  assign take_o = complete && !odd_q && rxd;
  assign spoil_o = complete && !take_o;
  assign byte_o = shift_q[7:0];

  // ---- the wait from the character's end on, bit - half cycles after its last sample (or from where a break ends): the rest of a bit,
  // then whole ones. While the chip sends it counts the bits sent.
  logic [2:0] code_q, code;
  logic [12:0] interval_bits, phase_q, bits_q, first, bits;
  logic [13:0] wait_0, wait_1, wait_2, wait_3, wait_4, wait_5, wait_6, wait_7;
  logic interval_odd, expired, sends_q, fires, bit_ends, starts_char;
  logic [7:0] tsdr;
  assign code = !waits_i ? code_q : interval_i != 3'd0 ? interval_i : uiv_i;
  assign wait_0 = wait_of(gaps_i[9:0]);
  assign wait_1 = wait_of(gaps_i[25:16]);
  assign wait_2 = wait_of(gaps_i[41:32]);
  assign wait_3 = wait_of(gaps_i[57:48]);
  assign wait_4 = wait_of(gaps_i[73:64]);
  assign wait_5 = wait_of(gaps_i[89:80]);
  assign wait_6 = wait_of(gaps_i[105:96]);
  assign wait_7 = wait_of(gaps_i[121:112]);
  always_comb begin
    case (code)
      3'd0: {interval_odd, interval_bits} = wait_0;
      3'd1: {interval_odd, interval_bits} = wait_1;
      3'd2: {interval_odd, interval_bits} = wait_2;
      3'd3: {interval_odd, interval_bits} = wait_3;
      3'd4: {interval_odd, interval_bits} = wait_4;
      3'd5: {interval_odd, interval_bits} = wait_5;
      3'd6: {interval_odd, interval_bits} = wait_6;
      default: {interval_odd, interval_bits} = wait_7;
    endcase
  end
  assign tsdr = tsdr_i > min_tsdr_i && !`FAULT(149) ? tsdr_i : min_tsdr_i;
  always_comb begin
    bits = interval_bits;
    if (last_i) begin
      first = rest_less(ubr_i, 13'd3);  // the synchroniser's two cycles are taken back
`ifdef SINGLE_FAULTS
      if (`FAULT(215)) first = half_less(ubr_i, 13'd3);
`endif
      bits = {5'd0, tsdr};
    end else if (break_ends) begin
      first = interval_odd ? half_less(ubr_i, 13'd0) : 13'd0;
    end else begin
      first = interval_odd ? bit_less(ubr_i, 13'd0) : rest_less(ubr_i, 13'd0);
    end
    if (`FAULT(148) && !last_i) first = first - 13'd1;
  end
  assign expired = phase_q == 13'd0 && bits_q == 13'd0;
  assign silence_o = run && expired && state_d == IDLE && !complete && !break_ends && !waits_i;

  // ---- transmitter
  logic [9:0] out_q;
  logic [3:0] bit_q;
  logic txd_q, parity;
  assign fires = answers_q && !sends_q && expired && !busy_i;
  assign bit_ends = sends_q && phase_q == 13'd0;
  assign starts_char = fires || (bit_ends && bit_q == 4'd10 && more_i);
  assign all_sent = bit_ends && bit_q == 4'd10 && !more_i;
  assign next_o = starts_char;
  assign parity = ^byte_i;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      code_q <= 3'd0;
      {phase_q, bits_q} <= 26'd0;
      {answers_q, sends_q} <= 2'b00;
      out_q <= 10'h3FF;
      bit_q <= 4'd0;
      txd_q <= 1'b1;
    end else begin
      if (complete) code_q <= code;
      if (complete || break_ends) begin
        phase_q <= first;
        bits_q <= bits;
      end else if (fires || bit_ends) begin
        phase_q <= bit_last;
      end else if (phase_q != 13'd0) begin
        phase_q <= phase_q - 13'd1;
      end else if (bits_q != 13'd0) begin
        phase_q <= bit_last;
        bits_q <= bits_q - 13'd1;
      end
`ifdef SINGLE_FAULTS
      if (`FAULT(216) && break_ends) {phase_q, bits_q} <= {phase_q, bits_q};
`endif

      if (judged_i) answers_q <= 1'b1;
      else if (all_sent) answers_q <= 1'b0;
      if (fires) sends_q <= 1'b1;
      else if (all_sent) sends_q <= 1'b0;
      if (starts_char) begin
        bit_q <= 4'd0;
        out_q <= {1'b1, parity, byte_i};
        txd_q <= 1'b0;
      end else if (all_sent) begin
        txd_q <= 1'b1;
      end else if (bit_ends) begin
        bit_q <= bit_q + 4'd1;
        out_q <= {1'b1, out_q[9:1]};
        txd_q <= out_q[0];
      end
    end
  end
  assign txd_o = txd_q;
endmodule
