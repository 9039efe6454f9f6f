// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The initialisation block while it is read (chapter 8; D7, D11): its values, and whether any is beyond its limit.
`include "dpram_types.svh"

module init_block (
  `FAULT_PORT
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        look_i,    // the length byte arrives
  input  logic        valid_i,   // a byte after it arrives
  input  logic [7:0]  index_i,   // its number, from 0
  input  logic [7:0]  byte_i,
  input  logic        last_i,    // the edge before the commit
  input  logic        crc_right_i,  // the edge of the commit, and its CRC is right
  output initialise_t initialise_o
);
  logic [6:0] address_byte_q;
  logic [15:0] ident_q;
  logic [3:0] command_q;
  logic [7:0] length_q, max_input_q, max_output_q, max_diag_q, max_prm_q, max_cfg_q, cfg_length_q;
  logic [1:0] prm_mode_q, cfg_mode_q;
  logic limits_wrong_q, in_cfg, cfg_complete;
  logic [12:0] cfg_input_length, cfg_output_length;
  assign in_cfg = valid_i && index_i >= 8'd14 && {1'b0, index_i} < {1'b0, cfg_length_q} + 9'd14;

  cfg_identifier u_identifier (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .clear_i(look_i), .valid_i(in_cfg), .byte_i(byte_i), .complete_o(cfg_complete),
    .input_length_o(cfg_input_length), .output_length_o(cfg_output_length));

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      address_byte_q <= 7'd0;
      ident_q <= 16'd0;
      command_q <= 4'd0;
      {max_input_q, max_output_q, max_diag_q, max_prm_q, max_cfg_q, cfg_length_q} <= 48'd0;
      {prm_mode_q, cfg_mode_q} <= 4'd0;
      limits_wrong_q <= 1'b0;
      length_q <= 8'd0;
    end else begin
      if (look_i) begin
        limits_wrong_q <= byte_i < 8'd14;
        length_q <= byte_i;
      end
      if (valid_i) begin
        case (index_i)
          8'd0: begin
            address_byte_q <= byte_i[6:0];
            if (byte_i > DSDPV1_REG_INIT_ADDRESS_LIMIT && !`FAULT(60)) limits_wrong_q <= 1'b1;
`ifdef SINGLE_FAULTS
            if (`FAULT(204) && byte_i == 8'd0) limits_wrong_q <= 1'b1;
`endif
          end
          8'd1: ident_q[15:8] <= byte_i;
          8'd2: ident_q[7:0] <= byte_i;
          8'd3: command_q <= byte_i[3:0];
          8'd6: begin
            max_input_q <= byte_i;
            if (byte_i > DSDPV1_REG_INIT_MAX_INPUT_LIMIT) limits_wrong_q <= 1'b1;
          end
          8'd7: begin
            max_output_q <= byte_i;
            if (byte_i > DSDPV1_REG_INIT_MAX_OUTPUT_LIMIT) limits_wrong_q <= 1'b1;
          end
          8'd8: begin
            max_diag_q <= byte_i;
            if (byte_i > DSDPV1_REG_INIT_MAX_DIAG_LIMIT) limits_wrong_q <= 1'b1;
          end
          8'd9: begin
            max_prm_q <= byte_i;
            if (byte_i > DSDPV1_REG_INIT_MAX_PRM_LIMIT) limits_wrong_q <= 1'b1;
          end
          8'd10: begin
            prm_mode_q <= byte_i[1:0];
            if (byte_i > 8'd2) limits_wrong_q <= 1'b1;
          end
          8'd11: begin
            max_cfg_q <= byte_i;
            if (byte_i > DSDPV1_REG_INIT_MAX_CFG_LIMIT) limits_wrong_q <= 1'b1;
          end
          8'd12: begin
            cfg_mode_q <= byte_i[1:0];
            if (byte_i > 8'd2) limits_wrong_q <= 1'b1;
          end
          8'd13: begin
            cfg_length_q <= byte_i;
            if (byte_i > max_cfg_q || {1'b0, length_q} < 9'd14 + {1'b0, byte_i}) limits_wrong_q <= 1'b1;
          end
          default: ;
        endcase
      end
      // the last byte of the configuration is decoded before the CRC arrives
      if (last_i &&
          (!cfg_complete || cfg_input_length > {5'd0, max_input_q} || cfg_output_length > {5'd0, max_output_q}))
        limits_wrong_q <= 1'b1;
    end
  end

  assign initialise_o.commit = crc_right_i && !limits_wrong_q;
  assign initialise_o.address = address_byte_q;
  assign initialise_o.ident = ident_q;
  assign {initialise_o.fail_safe, initialise_o.sync, initialise_o.freeze, initialise_o.set_address} = command_q;
  assign initialise_o.max_input = max_input_q;
  assign initialise_o.max_output = max_output_q;
  assign initialise_o.max_diag = max_diag_q;
  assign initialise_o.max_prm = max_prm_q;
  assign initialise_o.prm_mode = prm_mode_q;
  assign initialise_o.max_cfg = max_cfg_q;
  assign initialise_o.cfg_mode = cfg_mode_q;
  assign initialise_o.cfg_length = cfg_length_q;
  assign initialise_o.input_length = cfg_input_length[7:0];
  assign initialise_o.output_length = cfg_output_length[7:0];
endmodule
