// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Parameters of the DP slave (6.2.2; S6, S11, S28): those in force, and those that wait for the user's verdict.
`include "profibus_types.svh"

module dp_parameters (
`ifdef SINGLE_FAULTS
  `FAULT_PORT
`endif
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       init_i,            // an initialisation is committed
  input  logic       accept_waiting_i,  // a verdict puts those that wait in force, before the telegram
  // the telegram
  input  prm_t       prm_i,             // its parameters
  input  logic [6:0] sa_i,
  input  logic       waits_i,           // they are right: a verdict would be on them
  input  logic       accept_i,          // they are in force at once
  input  logic       min_tsdr_only_i,
  output logic       waiting_wd_on_o,
  output logic [6:0] waiting_sa_o,
  output prm_t       in_force_o
);
  localparam logic [37:0] RESET_VALUES = {18'd0, 8'd11, 12'd0};  // min_TSDR 11

  prm_t in_force_q, waiting_q;
  logic [6:0] waiting_sa_q;

  // min_TSDR: 0 leaves it, and 11 is the least (S6, S11)
  function automatic logic [7:0] new_min_tsdr(input logic [7:0] wish, input logic [7:0] old);
    if (wish == 8'd0) new_min_tsdr = old;
    else if (wish < 8'd11) new_min_tsdr = 8'd11;
    else new_min_tsdr = wish;
  endfunction

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      in_force_q <= RESET_VALUES;
    end else if (init_i) begin
      in_force_q <= RESET_VALUES;
    end else begin
      if (accept_waiting_i) begin
        in_force_q <= waiting_q;
        in_force_q.min_tsdr <= new_min_tsdr(waiting_q.min_tsdr, in_force_q.min_tsdr);
      end
      if (accept_i) in_force_q <= prm_i;
      if (accept_i || min_tsdr_only_i) in_force_q.min_tsdr <= new_min_tsdr(prm_i.min_tsdr, in_force_q.min_tsdr);
`ifdef SINGLE_FAULTS
      if (`FAULT(187) && waits_i) in_force_q.min_tsdr <= new_min_tsdr(prm_i.min_tsdr, in_force_q.min_tsdr);
`endif
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      waiting_q <= 38'd0;
      waiting_sa_q <= 7'd0;
    end else if (waits_i) begin
      waiting_q <= prm_i;
      waiting_sa_q <= sa_i;
    end
  end

  assign waiting_wd_on_o = waiting_q.wd_on;
  assign waiting_sa_o = waiting_sa_q;
  assign in_force_o = in_force_q;
endmodule
