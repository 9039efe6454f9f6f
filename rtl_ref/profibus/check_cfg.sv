// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Checks Check_Cfg (SAP 62; 6.2.3, D8, S16, S17) while the bytes arrive: decodes the identifiers, and compares them with the
// configuration of the initialisation, the one in use and the last one that was sent (which a verdict may put in use meanwhile).
`include "profibus_types.svh"

module check_cfg #(
  parameter logic [7:0] MAX_CFG = MOST_DATA,   // bytes of a configuration that the buffers and the user's side can take
  parameter logic [7:0] MAX_DATA = MOST_DATA   // ... of inputs, of outputs
) (
  `FAULT_PORT
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       begin_i,          // a telegram begins
  input  logic       valid_i,
  input  logic [7:0] index_i,
  input  logic [7:0] data_i,
  input  logic [7:0] length_i,
  input  logic       accept_commit_i,  // a verdict puts the last one sent in use, at this edge
  input  logic [7:0] last_length_i,
  input  logic [7:0] in_use_length_i,
  /* verilator lint_off UNUSEDSIGNAL */  // ident, address and the like are others'
  input  initialise_t initial_i,       // the initialisation in force: its configuration's length, limits, mode
  /* verilator lint_on UNUSEDSIGNAL */
  output logic [7:0] peek_index_o,     // for sap_buffers: bytes to compare with
  output logic       peek_last_o,
  input  logic [7:0] peek_bus_i,
  input  logic [7:0] peek_init_i,
  output logic       too_long_o,
  output logic       same_o,           // equal to the one in use
  output logic       right_o,          // accepted outside DATA_EXCH
  output logic [7:0] input_length_o,
  output logic [7:0] output_length_o
);
  logic complete;
  logic [12:0] input_length, output_length;

  cfg_identifier u_identifier (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .clear_i(begin_i), .valid_i(valid_i), .byte_i(data_i),
    .complete_o(complete), .input_length_o(input_length), .output_length_o(output_length));

  // Compare: 1 reads init and in use, 2 compares them and reads the last, 3 compares that
  logic [1:0] step_q;
  logic [7:0] index_q, data_q;
  logic same_init_q, same_in_use_q, same_last_q, moved_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      step_q <= 2'd0;
      index_q <= 8'd0;
      data_q <= 8'd0;
      same_init_q <= 1'b0;
      same_in_use_q <= 1'b0;
      same_last_q <= 1'b0;
      moved_q <= 1'b0;
    end else if (begin_i) begin
      step_q <= 2'd0;
      same_init_q <= 1'b1;
      same_in_use_q <= 1'b1;
      same_last_q <= 1'b1;
      moved_q <= accept_commit_i;
    end else begin
      if (accept_commit_i) moved_q <= 1'b1;
      if (valid_i) begin
        step_q <= 2'd1;
        index_q <= index_i;
        data_q <= data_i;
      end else if (step_q != 2'd0) begin
        step_q <= step_q + 2'd1;
      end
      if (step_q == 2'd2 && peek_init_i != data_q && !`FAULT(22)) same_init_q <= 1'b0;
      if (step_q == 2'd2 && peek_bus_i != data_q) same_in_use_q <= 1'b0;
      if (step_q == 2'd3 && peek_bus_i != data_q) same_last_q <= 1'b0;
    end
  end

  assign peek_index_o = index_q;
  assign peek_last_o = step_q == 2'd2;

  logic moved;
  assign moved = moved_q || accept_commit_i;
  assign same_o =
`ifdef SINGLE_FAULTS
      `FAULT(190) ? (moved ? same_last_q : same_in_use_q) :
`endif
      moved ? same_last_q && length_i == last_length_i : same_in_use_q && length_i == in_use_length_i;

  // Outside DATA_EXCH nothing but bytes and initialisation counts: through a register
  logic right_q, mode_right, decoded, fits;
  assign mode_right = initial_i.cfg_mode == 2'd0 ? length_i != 8'd0 && (length_i <= initial_i.max_cfg || `FAULT(23))
                                              : initial_i.cfg_mode != 2'd1 || (same_init_q && length_i == initial_i.cfg_length);
  assign decoded = complete && input_length <= {5'd0, MAX_DATA} && output_length <= {5'd0, MAX_DATA};
  assign fits = initial_i.cfg_mode == 2'd2 || (input_length <= {5'd0, initial_i.max_input} &&
                                               output_length <= {5'd0, initial_i.max_output});
  always_ff @(posedge clk_i) right_q <= mode_right && decoded && fits;

  assign too_long_o = length_i > MAX_CFG;
  assign right_o = right_q;
  assign input_length_o = input_length[7:0];
  assign output_length_o = output_length[7:0];
endmodule
