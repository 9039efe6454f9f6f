// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The master that holds the slave (S13, S15), and whether the telegram is from it.
//
// Both comparisons of SA stand still long before a decision; the commit of a verdict chooses between them.
`include "profibus_types.svh"

module dp_master (
  `FAULT_PORT
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       init_i,            // an initialisation is committed
  input  logic [6:0] sa_i,
  input  logic       accept_waiting_i,  // the commit accepts parameters
  input  logic [6:0] waiting_sa_i,      // ... of this master
  input  logic       held_i,            // there is a holder, after the commits
  input  logic       accept_i,          // the telegram is a Set_Prm that is accepted
  output logic [6:0] holder_o,          // after the commits; without a holder the last one
  output logic       from_holder_o,
  output logic       other_holder_o     // another master holds
);
  localparam logic [6:0] NO_MASTER = 7'h7F;

  logic [6:0] holder_q, holder_b;
  assign holder_b = accept_waiting_i ? waiting_sa_i : holder_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) holder_q <= NO_MASTER;
    else if (init_i) holder_q <= NO_MASTER;
    else if (accept_i) holder_q <= sa_i;
    else holder_q <= holder_b;
  end

  logic sa_is_holder_q, sa_is_waiting_q, sa_is_holder;
  always_ff @(posedge clk_i) begin
    sa_is_holder_q <= sa_i == holder_q;
    sa_is_waiting_q <= sa_i == waiting_sa_i;
  end
  assign sa_is_holder = accept_waiting_i ? sa_is_waiting_q : sa_is_holder_q;

  assign holder_o = holder_b;
  assign from_holder_o = held_i && sa_is_holder;
  assign other_holder_o = held_i && !sa_is_holder && !`FAULT(34);
endmodule
