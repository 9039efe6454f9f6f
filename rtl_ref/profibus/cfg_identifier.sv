// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Decodes configuration identifiers byte by byte (D11, S17): input and output lengths, and whether the bytes end with an identifier.
`include "profibus_types.svh"

module cfg_identifier (
  `FAULT_PORT
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        clear_i,
  input  logic        valid_i,
  input  logic [7:0]  byte_i,
  output logic        complete_o,
  output logic [12:0] input_length_o,
  output logic [12:0] output_length_o
);
  logic wants_output_q, wants_input_q;  // length bytes of a special format still to come, output first
  logic [3:0] skip_q;                   // bytes of the manufacturer still to come
  logic [12:0] input_q, output_q;

  logic at_identifier, special, at_output_length, at_input_length;
  assign at_output_length = wants_output_q;
  assign at_input_length = !wants_output_q && wants_input_q;
  assign at_identifier = !wants_output_q && !wants_input_q && skip_q == 4'd0;
  assign special = byte_i[5:4] == 2'b00;

  // Bytes that this byte stands for: a count less one, doubled for words
  logic [6:0] count;
  logic [7:0] bytes;
  assign count = {1'b0, at_identifier ? {2'b00, byte_i[3:0]} : byte_i[5:0]} + 7'd1;
  assign bytes = byte_i[6] && !`FAULT(17) ? {count, 1'b0} : {1'b0, count};

  logic adds_input, adds_output;
  assign adds_input = at_input_length || (at_identifier && byte_i[4]);
  assign adds_output = at_output_length || (at_identifier && byte_i[5]);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      wants_output_q <= 1'b0;
      wants_input_q <= 1'b0;
      skip_q <= 4'd0;
      input_q <= 13'd0;
      output_q <= 13'd0;
    end else if (clear_i) begin
      wants_output_q <= 1'b0;
      wants_input_q <= 1'b0;
      skip_q <= 4'd0;
      input_q <= 13'd0;
      output_q <= 13'd0;
    end else if (valid_i) begin
      if (adds_input) input_q <= input_q + {5'd0, bytes};
      if (adds_output) output_q <= output_q + {5'd0, bytes};
      if (at_output_length) wants_output_q <= 1'b0;
      else if (at_input_length) wants_input_q <= 1'b0;
      else if (at_identifier && special) begin
        wants_output_q <= byte_i[7];
        wants_input_q <= byte_i[6];
        skip_q <= byte_i[3:0] == 4'd15 ? 4'd0 : byte_i[3:0];
      end else if (!at_identifier) skip_q <= skip_q - 4'd1;
`ifdef SINGLE_FAULTS
      if (`FAULT(189) && at_identifier && special && byte_i[3:0] == 4'd14) skip_q <= 4'd0;
`endif
    end
  end

  assign complete_o = at_identifier;
  assign input_length_o = input_q;
  assign output_length_o = output_q;
endmodule
