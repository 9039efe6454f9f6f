// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// Properties of a DSDPV1's pins at every edge of CLK: the proved properties of rtl_ref/formal and rulings of docs/chip.md. dsdpv1_bind.sv
// binds them to the reference RTL or to RTL with its port names; the model keeps them as well.
//
// For simulators these are concurrent assertions (assert property). With DSDPV1_IMMEDIATE defined, for Icarus and Yosys, which have none,
// the same conditions are immediate assertions at the edges of CLK. With DSDPV1_ASSUME_USER defined the user's duties are assumed: for
// proofs.
`ifdef DSDPV1_IMMEDIATE
`define DSDPV1_HOLDS(name, condition) always @(posedge clk_i) if (reset_i && seen) begin : name assert (condition); end
`define DSDPV1_USER_KEEPS(name, condition) always @(posedge clk_i) if (reset_i && seen) begin : name assume (condition); end
`else
`define DSDPV1_HOLDS(name, condition) name: assert property (@(posedge clk_i) disable iff (!reset_i || !seen) condition);
`define DSDPV1_USER_KEEPS(name, condition) name: assume property (@(posedge clk_i) disable iff (!reset_i || !seen) condition);
`endif

module dsdpv1_assertions #(
  parameter integer RTS_LEAD = 4,   // P2
  parameter integer INTR_LOW = 64,  // P7
  parameter integer INTR_GAP = 64   // P7
) (
  input logic       reset_i,
  input logic       clk_i,
  input logic       pbtxd_o,
  input logic       pbrts_o,
  input logic       r_req_i,
  input logic       r_sta_i,
  input logic       l_req_o,
  input logic       l_sta_o,
  input logic       d_oe_o,
  input logic       csr_i,
  input logic       rd_i,
  input logic       intr0_o,
  input logic       pbf_o,
  input logic       br_o,
  input logic       ready_o
);
`ifndef YOSYS  // Yosys has no time
  timeunit 1ps;
  timeprecision 1ps;
`endif
  // Levels at earlier edges. `seen`: RESET has been low for four edges, after which no level is unknown.
  logic seen = 1'b0, had_pulse, ready_before, r_sta_before;
  logic [1:0] held_before;
  logic [2:0] in_reset = 3'd0;
  logic [15:0] low_for, high_for, rts_for;
  always @(posedge clk_i) begin
    if (reset_i) in_reset <= 3'd0;
    else if (in_reset != 3'd4) in_reset <= in_reset + 3'd1;
    if (in_reset == 3'd4) seen <= 1'b1;
  end
  always @(posedge clk_i or negedge reset_i) begin
    if (!reset_i) begin
      low_for <= 16'd0;
      high_for <= 16'd0;
      rts_for <= 16'd0;
      had_pulse <= 1'b0;
      ready_before <= 1'b0;
      r_sta_before <= 1'b0;
      held_before <= 2'b00;
    end else begin
      low_for <= intr0_o ? 16'd0 : low_for + 16'd1;
      high_for <= !intr0_o ? 16'd0 : high_for == 16'hFFFF ? high_for : high_for + 16'd1;
      had_pulse <= had_pulse || !intr0_o;
      rts_for <= !pbrts_o ? 16'd0 : rts_for == 16'hFFFF ? rts_for : rts_for + 16'd1;
      ready_before <= ready_o;
      r_sta_before <= r_sta_i;
      held_before <= {held_before[0], r_req_i || r_sta_i};
    end
  end
  wire intr0_falls = !intr0_o && low_for == 16'd0;

  // ---- proved for the reference RTL (docs/rtl.md)
  // L_REQ and L_STA are equal (H1).
  `DSDPV1_HOLDS(l_req_is_l_sta, l_req_o == l_sta_o)
  // The two sides never own the DPRAM at once, as long as the user keeps H2 (H1, H2, H6).
  `DSDPV1_HOLDS(one_owner, !(l_sta_o && r_sta_i))
  // A pulse of INTR0 lasts exactly INTR_LOW cycles (P7).
  `DSDPV1_HOLDS(intr0_not_longer, {16'd0, low_for} < INTR_LOW || intr0_o)
  `DSDPV1_HOLDS(intr0_not_shorter, !intr0_o || low_for == 16'd0 || {16'd0, low_for} == INTR_LOW)
  // Between two of them it is high for at least INTR_GAP cycles (P7).
  `DSDPV1_HOLDS(intr0_gap, !intr0_falls || !had_pulse || {16'd0, high_for} >= INTR_GAP)
  // PBTXD is low only while PBRTS is high (8.3).
  `DSDPV1_HOLDS(txd_idle_without_rts, pbtxd_o || pbrts_o)

  // ---- rulings
  // PBRTS is high for RTS_LEAD cycles before PBTXD falls (P2).
  `DSDPV1_HOLDS(rts_leads, pbtxd_o || {16'd0, rts_for} >= RTS_LEAD)
  // D is driven only in a read (P5).
  `DSDPV1_HOLDS(d_driven_in_reads_only, !d_oe_o || (!csr_i && !rd_i))
  // READY falls with RESET only (P3, D7).
  `DSDPV1_HOLDS(ready_stays, ready_o || !ready_before)
  // No rate and no data exchange before the initialisation (P3, S1).
  `DSDPV1_HOLDS(br_after_ready, !br_o || ready_o)
  `DSDPV1_HOLDS(exchange_after_ready, pbf_o || ready_o)
  // In reset (P10): from the fourth edge on.
  wire levels_of_reset = pbtxd_o && !pbrts_o && !l_req_o && !l_sta_o && intr0_o && pbf_o && !br_o && !ready_o;
`ifdef DSDPV1_IMMEDIATE
  always @(posedge clk_i) if (!reset_i && in_reset == 3'd4) begin : outputs_in_reset assert (levels_of_reset); end
  always @(posedge clk_i) if (!reset_i && in_reset == 3'd4) begin : d_released_in_reset assert (!d_oe_o); end
`else
  outputs_in_reset: assert property (@(posedge clk_i) reset_i || in_reset != 3'd4 || levels_of_reset);
  d_released_in_reset: assert property (@(posedge clk_i) reset_i || in_reset != 3'd4 || !d_oe_o);
`endif

  // ---- the user's side
`ifdef DSDPV1_ASSUME_USER
  // R_STA rises only while R_REQ is high, L_REQ and L_STA are sampled low, and R_REQ has been high for three edges: until then the chip may
  // still begin (H2's window for a user whose edges fall between those of CLK).
  `DSDPV1_USER_KEEPS(user_takes_turns, !r_sta_i || r_sta_before || (r_req_i && held_before == 2'b11 && !l_req_o && !l_sta_o))
`endif
endmodule
