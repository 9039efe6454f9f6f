// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Pending values of the chip's status bytes (9.2, section 10; D1, D5, D7, D16): which of them have to be written, and with which value.
`include "dpram_types.svh"

module chip_status (
  input  logic        clk_i,
  input  logic        rst_ni,
  // what there is to say
  input  logic        valid_due_i,     // B004
  input  logic [15:0] count_i,         // B008, B009
  input  logic [7:0]  state_i,         // B012
  input  logic        judged_i,        // the CRC of a block is judged at this edge
  input  logic        crc_wrong_i,
  input  logic [7:0]  error_bit_i,     // its bit in B00B
  input  logic        keeps_i,         // a right block does not clear it (D16)
  input  logic        clear_inputs_i,  // the user clears the inputs' bit at this edge (D16)
  input  logic        init_i,          // an initialisation is read, and at this edge
  input  logic        init_right_i,    // ... accepted
  input  logic        init_limits_i,   // ... its limits were checked
  // what is written at this edge, and what is due; B004 is the lowest, then B008, B009, B00A, B00B, B012, B013
  input  logic [6:0]  written_i,
  output logic [6:0]  due_o,
  output logic        initialised_o,   // for B00A
  output logic        limits_o,        // for B013
  output logic [7:0]  clear_o,         // for B00B
  output logic [7:0]  set_o
);
  logic [7:0] high_written_q, low_written_q, state_written_q, set_q, clear_q, count_high, count_low;
  logic valid_written_q, initialised_due_q, initialised_q, limits_due_q, limits_q;
  assign {count_high, count_low} = count_i;

  assign due_o = {
    limits_due_q,
    state_i != state_written_q,
    (set_q | clear_q) != 8'd0,
    initialised_due_q,
    count_low != low_written_q,
    count_high != high_written_q,
    valid_due_i && !valid_written_q};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {high_written_q, low_written_q, state_written_q, set_q, clear_q} <= 40'd0;
      {valid_written_q, initialised_due_q, initialised_q, limits_due_q, limits_q} <= 5'd0;
    end else begin
      if (written_i[0]) valid_written_q <= 1'b1;
      if (written_i[1]) high_written_q <= count_high;
      if (written_i[2]) low_written_q <= count_low;
      if (written_i[3]) initialised_due_q <= 1'b0;
      if (written_i[4]) begin
        set_q <= 8'd0;
        clear_q <= 8'd0;
      end
      if (written_i[5]) state_written_q <= state_i;
      if (written_i[6]) limits_due_q <= 1'b0;
      if (judged_i && crc_wrong_i) set_q <= set_q | error_bit_i;
      if (judged_i && !crc_wrong_i && !keeps_i) clear_q <= clear_q | error_bit_i;
      if (clear_inputs_i) clear_q <= clear_q | DSDPV1_REG_CHIP_STATUS_2_INPUT_CRC;
      if (init_i) begin
        initialised_due_q <= 1'b1;
        initialised_q <= init_right_i;
        if (init_limits_i) begin
          limits_due_q <= 1'b1;
          limits_q <= !init_right_i;
        end
      end
    end
  end

  assign initialised_o = initialised_q;
  assign limits_o = limits_q;
  assign clear_o = clear_q;
  assign set_o = set_q;
endmodule
