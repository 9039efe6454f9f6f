// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Watchdog (8.1; S1, S22, S29): BAUD_CONTROL watches for telegrams to this station, DP_CONTROL for those of the holding master.
//
// One timer of three nested counters, base time x WD_Fact_1 x WD_Fact_2; BAUD_CONTROL uses the innermost only. It is loaded one edge
// after its start, and its end is seen one edge ahead, so that neither lengthens the path through a decision.
`include "profibus_types.svh"

module watchdog (
  `FAULT_PORT
  input  logic [31:0] baud_control_ms_i,
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        stop_i,            // the search starts by an initialisation
  input  logic        found_i,           // the rate is found
  input  logic        commit_dp_i,       // a verdict accepts parameters with WD_On, ahead of an end at the same edge
  input  logic        commit_baud_i,     // ... without WD_On, or one that leads to WAIT_PRM
  input  logic        trigger_i,         // telegram to the own address
  input  logic        trigger_holder_i,  // ... of the holding master
  input  logic        accept_dp_i,       // Set_Prm accepted with WD_On, after an end at the same edge
  input  logic        accept_baud_i,     // Set_Prm accepted without WD_On
  input  logic        wait_prm_i,        // WAIT_PRM entered by refusal, Unlock, wrong length
  input  logic [7:0]  factor_1_i,        // of the parameters in use, at the edge after their acceptance
  input  logic [7:0]  factor_2_i,
  input  logic        base_1ms_i,
  output logic        baud_end_o,        // BAUD_CONTROL ends at this edge
  output logic        dp_end_o,          // DP_CONTROL ends at this edge
  output logic        dp_control_o       // before the edge
);
  localparam logic [31:0] BASE_1MS = 32'd47999;
  localparam logic [31:0] BASE_10MS = 32'd479999;

  logic [1:0] state_q, state_d;
  logic [31:0] base_q, base_d, base_start_q;
  logic [7:0] inner_q, inner_d, outer_q, outer_d, inner_start_q;
  logic last_q, load_dp_q, load_baud_q;
  logic ended, load_dp, load_baud;
  logic [31:0] dp_base, baud_control;

  assign ended = last_q && !commit_dp_i && !commit_baud_i && !stop_i;
  assign baud_end_o = state_q == WD_BAUD_CONTROL && ended;
  assign dp_end_o = dp_control_o && ended;
  assign dp_control_o = state_q >= WD_DP_CONTROL;  // 3: no such state
  assign baud_control = baud_control_ms_i * 32'd48000 - 32'd2;
  assign dp_base = base_1ms_i && !`FAULT(15) ? BASE_1MS : BASE_10MS;

  // No rate, no watchdog: while it is searched, one that a verdict starts waits for it. Its time waits in the parameters in use.
  logic waits_q, waits, starts;
  assign waits = state_q == WD_OFF && (waits_q || commit_dp_i) && !`FAULT(153);
  assign starts = `FAULT(155) ? waits_q : waits;

  // In the order of the cycle: commit, end, telegram.
  logic dp_state;
  always_comb begin
    state_d = dp_control_o ? WD_DP_CONTROL : state_q;
    load_dp = 1'b0;
    load_baud = 1'b0;
    if (state_q != WD_OFF) begin
      if (commit_dp_i) begin
        state_d = WD_DP_CONTROL;
        load_dp = 1'b1;
      end else if (commit_baud_i || dp_end_o) begin
        state_d = WD_BAUD_CONTROL;
        load_baud = 1'b1;
      end
    end
    dp_state = state_d == WD_DP_CONTROL;
    if (state_q != WD_OFF) begin
      if (accept_dp_i) begin
        state_d = WD_DP_CONTROL;
        load_dp = 1'b1;
        load_baud = 1'b0;
      end else if (accept_baud_i || (wait_prm_i && dp_state) || (trigger_i && !dp_state && !`FAULT(16))) begin
        state_d = WD_BAUD_CONTROL;
        load_dp = 1'b0;
        load_baud = 1'b1;
      end else if (trigger_holder_i && dp_state) begin
        load_dp = 1'b1;
      end
    end
    if (found_i) begin
      state_d = starts ? WD_DP_CONTROL : WD_BAUD_CONTROL;
      load_dp = starts;
      load_baud = !starts;
    end
    if (stop_i || baud_end_o) begin
      state_d = WD_OFF;
      load_dp = 1'b0;
      load_baud = 1'b0;
    end
`ifdef SINGLE_FAULTS
    if (`FAULT(198) && trigger_i && dp_state && state_d == WD_DP_CONTROL) load_dp = 1'b1;
`endif
  end

  always_comb begin
    base_d = base_q - 32'd1;
    inner_d = inner_q;
    outer_d = outer_q;
    if (load_dp_q) begin
      base_d = dp_base - 32'd1;
      inner_d = factor_1_i - 8'd1;
      outer_d = factor_2_i - 8'd1;
    end else if (load_baud_q) begin
      base_d = baud_control;
      inner_d = 8'd0;
      outer_d = 8'd0;
    end else if (base_q == 32'd0) begin
      base_d = base_start_q;
      inner_d = inner_q == 8'd0 ? inner_start_q : inner_q - 8'd1;
      if (inner_q == 8'd0) outer_d = outer_q - 8'd1;
    end
`ifdef SINGLE_FAULTS
    if (`FAULT(178) && load_dp_q && factor_2_i > 8'd1) outer_d = factor_2_i;
`endif
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= WD_OFF;
      base_q <= 32'd0;
      base_start_q <= 32'd0;
      inner_q <= 8'd0;
      inner_start_q <= 8'd0;
      outer_q <= 8'd0;
      {last_q, load_dp_q, load_baud_q, waits_q} <= 4'b0000;
    end else begin
      state_q <= state_d;
      base_q <= base_d;
      inner_q <= inner_d;
      outer_q <= outer_d;
      load_dp_q <= load_dp;
      load_baud_q <= load_baud;
      waits_q <= waits && !found_i && (!stop_i || `FAULT(154));
      last_q <= !load_dp && !load_baud && !load_dp_q && !load_baud_q && base_q == 32'd1 && inner_q == 8'd0 && outer_q == 8'd0;
      if (load_dp_q) begin
        base_start_q <= dp_base;
        inner_start_q <= factor_1_i - 8'd1;
      end
    end
  end
endmodule
