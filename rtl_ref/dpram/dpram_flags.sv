// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Copies of the four flag registers in an access (9.1: U, W, E, V): user_1 is B010, user_2 B011, chip_1 B00E, chip_2 B00F.
//
// A flag of the user falls in its copy with the commit of its item, a flag of the chip rises with the block that it announces. The registers
// in the DPRAM are written with these copies.
`include "dpram_types.svh"

module dpram_flags (
  `FAULT_PORT
  input  logic       clk_i,
  input  logic       rst_ni,
  input  seq_t       state_i,
  input  item_t      item_i,
  input  logic       history_i,     // the request to clear B00B.2 is done at this edge (D16)
  input  logic [7:0] rdata_i,
  output logic [7:0] due_o,         // the user's flags, in the order of 9.2, the first in bit 0
  output logic [6:0] user_2_o,      // B011 without bit 7
  output logic [7:0] user_flags_o,  // B010 or B011, after the commit of this item
  output logic [7:0] chip_flags_o   // B00E or B00F, after the flag of this item
);
  logic [7:0] user_1_q, user_2_q, chip_1_q, chip_2_q;
  logic answers, requests;
  assign answers = is_answer(item_i);
  assign requests = is_request(item_i);

  // ---- the flags that this item changes
  logic [7:0] user_1_without, user_2_without, chip_1_with, chip_2_with;
  logic flags_c2;
  always_comb begin
    case (item_i)
      ITEM_INIT: user_1_without = user_1_q & 8'hFB;
      ITEM_VERDICT_PRM: user_1_without = user_1_q & 8'h7F;
      ITEM_VERDICT_CFG: user_1_without = user_1_q & 8'hBF;
      ITEM_INPUTS: user_1_without = user_1_q & 8'hFE;
      default: user_1_without = user_1_q & 8'hFD;
    endcase
  end
  always_comb begin
    case (item_i)
      ITEM_PRM: chip_1_with = chip_1_q | DSDPV1_REG_CHIP_COMMAND_1_PRM;
      ITEM_CFG: chip_1_with = chip_1_q | DSDPV1_REG_CHIP_COMMAND_1_CFG;
      default: chip_1_with = chip_1_q | DSDPV1_REG_CHIP_COMMAND_1_OUTPUT;
    endcase
  end
  assign user_2_without = user_2_q & (item_i == ITEM_C1_ANSWER ? 8'hFE : 8'hFD);
  assign flags_c2 = item_i == ITEM_C2_REQUEST || `FAULT(88);
  assign chip_2_with = chip_2_q | (flags_c2 ? DSDPV1_REG_CHIP_COMMAND_2_C2 : DSDPV1_REG_CHIP_COMMAND_2_C1);

  // ---- the user's flags
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) user_1_q <= 8'd0;
    else if (state_i == SEQ_USER_2) user_1_q <= rdata_i;
    else if (state_i == SEQ_COMMIT && !answers) user_1_q <= user_1_without;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) user_2_q <= 8'd0;
    else if (state_i == SEQ_CHIP_1) user_2_q <= rdata_i;
    else if (state_i == SEQ_COMMIT && answers) user_2_q <= user_2_without;
    else if (history_i) user_2_q[7] <= 1'b0;
  end

  // ---- the chip's flags
  logic keeps_flags;
  assign keeps_flags = state_i != SEQ_FLAG || `FAULT(202);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) chip_1_q <= 8'd0;
    else if (state_i == SEQ_CHIP_2) chip_1_q <= rdata_i;
    else if (!keeps_flags && !requests) chip_1_q <= chip_1_with;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) chip_2_q <= 8'd0;
    else if (state_i == SEQ_ENABLE) chip_2_q <= rdata_i;
    else if (!keeps_flags && requests) chip_2_q <= chip_2_with;
  end

  assign due_o = {
    user_2_q[1],
    user_2_q[0],
    user_1_q[1],
    user_1_q[0],
    user_2_q[7],
    user_1_q[6],
    user_1_q[7],
    user_1_q[2]};
  assign user_2_o = user_2_q[6:0];
  assign user_flags_o = answers ? user_2_without : user_1_without;
  assign chip_flags_o = requests ? chip_2_with : chip_1_with;
endmodule
