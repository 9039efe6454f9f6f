// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Banks of the user's data (S4, S18, S27): input buffers 1 and 2, the diagnosis, the configuration of the initialisation, and those that a block
// of the user is being read into.
//
// At an edge: the user's commits and the end of DP_CONTROL, _b after them, then the telegram, _d after it.
`include "profibus_types.svh"

module user_banks (
  `FAULT_PORT
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       init_i,           // an initialisation is committed
  // blocks of the user
  input  logic       begin_inputs_i,   // one begins
  input  logic       begin_diag_i,
  input  logic       commit_inputs_i,
  input  logic       commit_diag_i,
  // the DP slave
  input  logic       clear_commit_i,   // the commit puts a configuration with other inputs into use
  input  logic       end_leave_i,      // DATA_EXCH is left with the end of DP_CONTROL
  input  logic       hold_i,           // freeze holds, before the edge
  input  logic       copy_i,           // the telegram is Freeze or Unfreeze
  input  logic       leave_i,          // the telegram leaves DATA_EXCH
  input  logic       clear_telegram_i, // the telegram puts a configuration with other inputs into use
  // the answer that is being sent keeps its bank
  input  logic       sends_inputs_i,
  input  logic       sends_diag_i,
  input  logic [1:0] sent_i,
  // banks: after the commits
  output logic [1:0] in1_o,
  output logic [1:0] in2_o,
  output logic       in2_zero_o,       // cleared: every byte is 0
  output logic [1:0] diag_o,
  // ... before the edge
  output logic [1:0] stage_inputs_o,
  output logic [1:0] stage_diag_o,
  output logic       init_o
);
  logic [1:0] in1_q, in1_b, in2_q, in2_b, in2_d, stage_inputs_q;
  logic in1_zero_q, in1_zero_b, in1_zero_d, in2_zero_q, in2_zero_b, in2_zero_d;

  // ---- inputs, after the commits and the end of DP_CONTROL
  always_comb begin
    in1_b = in1_q;
    in1_zero_b = in1_zero_q;
    if (commit_inputs_i) begin
      in1_b = stage_inputs_q;
      in1_zero_b = 1'b0;
    end
    if (clear_commit_i) in1_zero_b = 1'b1;
  end
  always_comb begin
    in2_b = in2_q;
    in2_zero_b = in2_zero_q;
    if (commit_inputs_i && (!hold_i || `FAULT(28))) begin
      in2_b = stage_inputs_q;
      in2_zero_b = 1'b0;
    end
    if (clear_commit_i) in2_zero_b = 1'b1;
    if (end_leave_i) begin
      in2_b = in1_b;
      in2_zero_b = in1_zero_b;
    end
  end

  // ---- inputs, after the telegram
  logic copies;
  assign copies =
`ifdef SINGLE_FAULTS
      !(`FAULT(193) && leave_i && hold_i) &&
`endif
      (leave_i || (copy_i && !`FAULT(29)));
  assign in1_zero_d = in1_zero_b || clear_telegram_i;
  assign in2_d = copies ? in1_b : in2_b;
  assign in2_zero_d = (copies ? in1_zero_b : in2_zero_b) || clear_telegram_i;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {in1_q, in2_q} <= 4'd0;
      {in1_zero_q, in2_zero_q} <= 2'b11;
    end else begin
      in1_q <= in1_b;
      in2_q <= in2_d;
      in1_zero_q <= in1_zero_d || init_i;
      in2_zero_q <= in2_zero_d || init_i;
    end
  end

  // ---- diagnosis
  logic [1:0] diag_q, diag_b, stage_diag_q;
  assign diag_b = commit_diag_i ? stage_diag_q : diag_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) diag_q <= 2'd0;
    else diag_q <= diag_b;
  end

  // ---- the initialisation's configuration: the other one of two banks is read into
  logic init_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) init_q <= 1'b0;
    else if (init_i) init_q <= !init_q;
  end

  // ---- banks that blocks are read into: neither in use nor being sent
  function automatic logic [1:0] other_than(input logic [1:0] a, input logic [1:0] b, input logic [1:0] c);
    if (a != 2'd0 && b != 2'd0 && c != 2'd0) other_than = 2'd0;
    else if (a != 2'd1 && b != 2'd1 && c != 2'd1) other_than = 2'd1;
    else if (a != 2'd2 && b != 2'd2 && c != 2'd2) other_than = 2'd2;
    else other_than = 2'd3;
  endfunction
  logic [1:0] free_inputs, free_diag;
  assign free_inputs = other_than(in1_q, in2_q, sends_inputs_i ? sent_i : in2_q);
  assign free_diag = other_than(diag_q, diag_q, sends_diag_i ? sent_i : diag_q);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      stage_inputs_q <= 2'd0;
      stage_diag_q <= 2'd0;
    end else begin
      if (begin_inputs_i) stage_inputs_q <= free_inputs;
      if (begin_diag_i) stage_diag_q <= free_diag;
    end
  end

  assign in1_o = in1_b;
  assign in2_o = in2_b;
  assign in2_zero_o = in2_zero_b;
  assign diag_o = diag_b;
  assign stage_inputs_o = stage_inputs_q;
  assign stage_diag_o = stage_diag_q;
  assign init_o = init_q;
endmodule
