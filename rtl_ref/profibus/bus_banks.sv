// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Banks of data from the bus (S4, S18, S27): output buffers 1 and 2, parameters, the last configuration and the one in use, the one of the
// transfer to the user, and the one that a telegram is received into.
//
// Events of one edge act in the order of section 3: the user's commits, the end of DP_CONTROL, the telegram.
`include "profibus_types.svh"

module bus_banks (
  `FAULT_PORT
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       begin_i,           // a telegram's bytes begin
  input  logic       init_i,            // an initialisation is committed
  // transfers to the user that begin
  input  logic       take_prm_i,
  input  logic       take_cfg_i,
  input  logic       take_outputs_i,
  // the telegram's bytes become
  input  logic       prm_i,             // the parameters
  input  logic       cfg_i,             // the last configuration
  input  logic       store_i,           // outputs
  // configuration into use, by a verdict or by the telegram
  input  logic       commit_accept_cfg_i,
  input  logic       accept_cfg_i,
  // outputs
  input  logic       hold_i,            // sync holds
  input  logic       copy_i,            // Sync or Unsync
  input  logic       clear_i,           // Clear_Data
  input  logic       leave_i,           // DATA_EXCH is left, by a telegram
  input  logic       end_leave_i,       // ... with the end of DP_CONTROL
  output logic       outputs_new_o,     // output buffer 2 is written at this edge: cleared or copied
  // banks
  output logic [2:0] receive_o,
  output logic [2:0] last_o,
  output logic [2:0] in_use_o,
  output logic [2:0] in_use_now_o,      // after the commits
  output logic [2:0] out2_o,
  output logic       out2_zero_o,       // cleared: every byte is 0
  output logic [2:0] transfer_o,        // after a transfer's begin at this edge
  output logic       transfer_zero_o    // every byte of it is 0
);
  // ---- outputs: a bank, or cleared
  logic [2:0] receive_q, out1_q, out1_d, out2_q, out2_d;
  logic out1_zero_q, out1_zero_d, out2_zero_q, out2_zero_d, clears, copies;
  assign clears = commit_accept_cfg_i || end_leave_i || leave_i || clear_i || accept_cfg_i;
  assign copies = (store_i && (!hold_i || `FAULT(31))) || copy_i;
  always_comb begin
    out1_d = out1_q;
    out1_zero_d = clears ? !`FAULT(30) : out1_zero_q;
    if (store_i) begin
      out1_d = receive_q;
      out1_zero_d = 1'b0;
    end
  end
  always_comb begin
    out2_d = out2_q;
    out2_zero_d = clears ? !`FAULT(30) : out2_zero_q;
    if (copies) begin
      out2_d = out1_d;
      out2_zero_d = out1_zero_d;
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {out1_q, out2_q} <= 6'd0;
      {out1_zero_q, out2_zero_q} <= 2'b11;
    end else begin
      out1_q <= out1_d;
      out2_q <= out2_d;
      out1_zero_q <= out1_zero_d || init_i;
      out2_zero_q <= out2_zero_d || init_i;
    end
  end
  assign outputs_new_o = end_leave_i || leave_i || clear_i || copies;

  // ---- parameters and configurations
  logic [2:0] prm_q, last_q, in_use_q, in_use_b, in_use_d;
  assign in_use_b = commit_accept_cfg_i ? last_q : in_use_q;
  assign in_use_d = accept_cfg_i ? receive_q : in_use_b;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {prm_q, last_q, in_use_q} <= 9'd0;
    end else begin
      if (prm_i) prm_q <= receive_q;
      if (cfg_i) last_q <= receive_q;
      in_use_q <= in_use_d;
    end
  end

  // ---- the transfer keeps the bank that it began with
  logic [2:0] transfer_q, transfer_d, taken_outputs;
  logic takes, transfer_zero_q, transfer_is_output_q;
  assign takes = take_prm_i || take_cfg_i || take_outputs_i;
  assign taken_outputs = `FAULT(32) ? out1_q : out2_q;
  assign transfer_d = take_prm_i ? prm_q : take_cfg_i ? last_q : take_outputs_i ? taken_outputs : transfer_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      transfer_q <= 3'd0;
      {transfer_zero_q, transfer_is_output_q} <= 2'b00;
    end else begin
      transfer_q <= transfer_d;
      if (takes) begin
        transfer_is_output_q <= take_outputs_i;
        transfer_zero_q <= out2_zero_q;
      end
    end
  end

  // ---- reception: a bank that is none of the six others
  logic [6:0] used, bit_out1, bit_out2, bit_prm, bit_last, bit_in_use, bit_transfer;
  logic [2:0] free;
  assign bit_out1 = 7'd1 << out1_q;
  assign bit_out2 = 7'd1 << out2_q;
  assign bit_prm = 7'd1 << prm_q;
  assign bit_last = 7'd1 << last_q;
  assign bit_in_use = 7'd1 << in_use_q;
  assign bit_transfer = 7'd1 << transfer_q;
  assign used = bit_out1 | bit_out2 | bit_prm | bit_last | bit_in_use | bit_transfer;
  always_comb begin
    casez (used)
      7'b??????0: free = 3'd0;
      7'b?????01: free = 3'd1;
      7'b????011: free = 3'd2;
      7'b???0111: free = 3'd3;
      7'b??01111: free = 3'd4;
      7'b?011111: free = 3'd5;
      default: free = 3'd6;
    endcase
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) receive_q <= 3'd0;
    else if (begin_i) receive_q <= free;
  end

  assign receive_o = receive_q;
  assign last_o = last_q;
  assign in_use_o = in_use_q;
  assign in_use_now_o = in_use_b;
  assign out2_o = out2_q;
  assign out2_zero_o = out2_zero_q;
  assign transfer_o = transfer_d;
  assign transfer_zero_o = transfer_is_output_q && transfer_zero_q;
endmodule
