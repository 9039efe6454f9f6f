// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Receiver of characters (section 6; S2, S10): 11 bits, sampled at mid-bit from the synchronised falling edge.
//
// A character that is complete at edge C is passed on registered, that is, telegram_rx uses it at edge C+1; nothing can be decided
// before C+7. Three counters are here because they start from C: the idle time, the deadline of the telegram and the clock of the answer.
`include "profibus_types.svh"

module uart_rx (
  `FAULT_PORT
  input  logic [5:0]  rts_lead_i,
  input  logic [5:0]  rts_trail_i,
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        rxd_i,
  input  logic        run_i,           // initialised, and PBRTS was low before the edge
  input  logic [3:0]  rate_i,
  input  logic        restart_rate_i,  // a rate is selected at this edge
  input  logic        restart_rts_i,   // PBRTS falls at this edge
  output logic        busy_o,          // RECEIVING after this edge, or a character is complete at it
  output logic        valid_o,         // a character was complete at the last edge
  output logic [7:0]  char_o,
  output logic        ok_o,            // parity and stop bit right
  output logic        syn_o,           // it began after SYN
  output logic        gap_o,           // it began after a gap
  output logic        due_o,           // the deadline of the last character is reached
  output logic [5:0]  clock_bits_o,    // bit times since (end of the last character - 2 - lead), as of the next edge
  output logic [12:0] clock_phase_o    // cycles left of the running one, less one
);
  typedef enum logic [1:0] {
    IDLE = 2'd0,
    RECEIVING = 2'd1,
    BREAK = 2'd2
  } state_t;

  logic [1:0] state_q, state_d;
  logic [12:0] timer_q, timer_d;
  logic tick_q;  // the timer is 0
  logic [3:0] sample_q;  // number of the next sample: 0 start bit, 1..8 data, 9 parity, 10 stop
  logic [8:0] shift_q;
  logic start_bit_q, stop_bit_q, odd_q;
  logic syn_q, gap_q, due_q;
  logic [12:0] deadline_q;
  logic signed [18:0] idle_q;

  logic [12:0] bit_len, half;
  logic starts, samples, glitch, complete, syn, gap;
  assign bit_len = bit_cycles(rate_i);
  assign half = {1'b0, bit_len[12:1]};
  assign starts = run_i && state_q == IDLE && !rxd_i;
  assign samples = run_i && state_q == RECEIVING && tick_q;
  assign glitch = samples && start_bit_q && rxd_i && !`FAULT(1);
  assign complete = samples && stop_bit_q;

  // Idle before the edge: 33 bit times less the cycle of sampling are SYN, more than one is a gap (S10, section 7).
  logic signed [18:0] syn_limit, gap_limit;
  assign syn_limit = $signed({1'b0, bit_len, 5'd0}) + $signed({6'd0, bit_len}) - (`FAULT(2) ? 19'sd0 : 19'sd1);
  assign gap_limit = $signed({6'd0, bit_len});
  assign syn = idle_q >= syn_limit;
  assign gap = `FAULT(3) ? idle_q >= gap_limit : idle_q > gap_limit;

  always_comb begin
    state_d = state_q >= BREAK ? BREAK : state_q;  // 3: no such state
    if (starts) state_d = RECEIVING;
    else if (glitch) state_d = IDLE;
    else if (complete) state_d = rxd_i ? IDLE : BREAK;
    else if (run_i && state_q == BREAK && rxd_i) state_d = IDLE;
    if (restart_rate_i || restart_rts_i) state_d = rxd_i ? IDLE : BREAK;
`ifdef SINGLE_FAULTS
    if (`FAULT(180) && complete && !restart_rate_i) state_d = IDLE;
    if (`FAULT(181) && restart_rts_i && !restart_rate_i) state_d = IDLE;
`endif
  end

  always_comb begin
    timer_d = timer_q - 13'd1;
    if (starts) timer_d = half - (`FAULT(4) ? 13'd0 : 13'd1);
    else if (samples) timer_d = bit_len - 13'd1;
`ifdef SINGLE_FAULTS
    if (`FAULT(179) && starts && rate_i == 4'd7) timer_d = half - 13'd2;
`endif
  end

  assign busy_o = starts || (run_i && state_q == RECEIVING && !glitch);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= IDLE;
      timer_q <= 13'd0;
      tick_q <= 1'b1;
      {start_bit_q, stop_bit_q} <= 2'b00;
      sample_q <= 4'd0;
      shift_q <= 9'd0;
      odd_q <= 1'b0;
      syn_q <= 1'b0;
      gap_q <= 1'b0;
      valid_o <= 1'b0;
      ok_o <= 1'b0;
      deadline_q <= 13'd0;
      due_q <= 1'b1;
    end else begin
      state_q <= state_d;
      timer_q <= timer_d;
      tick_q <= timer_d == 13'd0;
      if (starts) begin
        sample_q <= 4'd0;
        start_bit_q <= 1'b1;
        stop_bit_q <= 1'b0;
        odd_q <= 1'b0;
        syn_q <= syn;
        gap_q <= gap;
      end else if (samples) begin
        sample_q <= sample_q + 4'd1;
        start_bit_q <= 1'b0;
        stop_bit_q <= sample_q == 4'd9;
        if (!start_bit_q && !complete) begin
          shift_q <= {rxd_i, shift_q[8:1]};
          odd_q <= odd_q ^ rxd_i;
        end
      end
      valid_o <= complete && !restart_rate_i;
      ok_o <= (!odd_q || `FAULT(5)) && (rxd_i || `FAULT(6));

      // C + bit + half + 1 is S + 12 bit + 1
      if (complete) begin
        deadline_q <= `FAULT(7) ? bit_len + half + 13'd1 : bit_len + half;
        due_q <= 1'b0;
      end else if (deadline_q == 13'd0) begin
        due_q <= 1'b1;
      end else begin
        deadline_q <= deadline_q - 13'd1;
        due_q <= deadline_q == 13'd1;
      end
    end
  end

  assign char_o = shift_q[7:0];
  assign syn_o = syn_q;
  assign gap_o = gap_q;
  assign due_o = due_q;

  // idle_q is the edge's distance from idle_since. It stands still when SYN is reached.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) idle_q <= 19'sd0;
    else if (restart_rate_i) idle_q <= 19'sd1;
    else if (restart_rts_i) idle_q <= $signed({13'd0, rts_trail_i}) - (`FAULT(62) ? 19'sd3 : 19'sd2);  // from E + 3
    else if (complete) idle_q <= 19'sd1 - $signed({6'd0, half});
    else if (run_i && state_q == BREAK && rxd_i) idle_q <= `FAULT(8) ? idle_q + 19'sd1 : 19'sd1;
    else if (!syn) idle_q <= idle_q + 19'sd1;
  end

  // The clock of the answer (8.3): at C + 1 it stands at lead + 3 - half cycles, written as bit times and the rest of one.
  function automatic integer clock_start(input integer lead_cycles, input integer len);
    integer ahead, bits;
    begin
      ahead = lead_cycles + 3 - len / 2;
      bits = (ahead + 1024 * len) / len - 1024;
      clock_start = bits * 8192 + len - 1 - (ahead - bits * len);
    end
  endfunction

  logic [5:0] clock_bits_q;
  logic [12:0] clock_phase_q;
  logic [18:0] start;
  logic [12:0] unused;
  logic [31:0] lead;
  logic [319:0] clock_starts;  // index 0 lowest
  assign lead = {26'd0, rts_lead_i};
  assign clock_starts = {
    clock_start(lead, 5000), clock_start(lead, 2500), clock_start(lead, 1056), clock_start(lead, 512),
    clock_start(lead, 256), clock_start(lead, 96), clock_start(lead, 32), clock_start(lead, 16), clock_start(lead, 8),
    clock_start(lead, 4)};
  assign {unused, start} = clock_starts[{rate_i, 5'd0}+:32];

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      clock_bits_q <= 6'd0;
      clock_phase_q <= 13'd0;
    end else if (complete) begin
      {clock_bits_q, clock_phase_q} <= start;
    end else if (clock_phase_q == 13'd0) begin
      clock_bits_q <= clock_bits_q + 6'd1;
      clock_phase_q <= bit_len - 13'd1;
    end else begin
      clock_phase_q <= clock_phase_q - 13'd1;
    end
  end

  assign clock_bits_o = clock_bits_q;
  assign clock_phase_o = clock_phase_q;
endmodule
