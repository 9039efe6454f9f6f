// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The commands that commits of a DPRAM access give the station (section 10; H7, D7, D12 to D17), and the judgement of each block's CRC.
`include "dpram_types.svh"

module dpram_commit (
  `FAULT_PORT
  input  logic        clk_i,
  input  logic        rst_ni,
  input  seq_t        state_i,
  input  item_t       item_i,
  input  logic        initialised_i,     // else all blocks but the initialisation are dropped
  // bytes as they arrive
  input  logic        verdict_arrives_i,
  input  logic        init_arrives_i,    // one of the initialisation
  input  logic [7:0]  index_i,           // its number, from 0
  input  logic [7:0]  byte_i,
  // the block, at the commit
  input  logic [7:0]  length_i,
  input  logic        too_long_i,
  input  logic        crc_wrong_i,
  // at this edge
  output initialise_t initialise_o,
  output verdict_t    verdict_o,
  output inputs_t     inputs_o,
  output diagnosis_t  diagnosis_o,
  output answers_t    answers_o,
  // for the status bytes
  output logic        judged_o,          // the CRC is judged
  output logic        judged_init_o,     // an initialisation is read
  output logic        init_limits_o,     // ... and its limits were checked
  output logic [7:0]  error_bit_o        // of the block in B00B
);
  logic verdict_wrong_q;
  logic [7:0] type_q;
  logic [1:0] verdict_bits, kind;
  assign verdict_bits = byte_i[1:0];
  always_ff @(posedge clk_i) begin
    if (verdict_arrives_i) verdict_wrong_q <= item_i == ITEM_VERDICT_PRM || `FAULT(59) ? verdict_bits[0] : verdict_bits[1];
    if (state_i == SEQ_READ_HEADER) type_q <= byte_i;  // of the diagnosis
  end
  always_comb begin
    case (type_q)
      DSDPV1_REG_DIAG_TYPE_EXTENDED: kind = DIAG_EXTENDED;
      DSDPV1_REG_DIAG_TYPE_EXTERNAL_GONE, DSDPV1_REG_DIAG_TYPE_EXTERNAL_PRESENT: kind = DIAG_EXTERNAL;
      DSDPV1_REG_DIAG_TYPE_STATIC_GONE, DSDPV1_REG_DIAG_TYPE_STATIC_PRESENT: kind = DIAG_STATIC;
      default: kind = DIAG_UNKNOWN;
    endcase
  end

  // ---- initialisation
  logic init_look, init_last, init_crc_right;
  assign init_look = state_i == SEQ_READ_LOOK && item_i == ITEM_INIT;
  assign init_last = state_i == SEQ_READ_LAST && item_i == ITEM_INIT;
  init_block u_init_block (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .look_i(init_look), .valid_i(init_arrives_i), .index_i(index_i), .byte_i(byte_i),
    .last_i(init_last), .crc_right_i(init_crc_right), .initialise_o(initialise_o));

  // The item of the commit is known an edge ahead
  logic commits, readable, commit_init_q, commit_inputs_q, commit_diag_q, commit_c1_q, commit_c2_q;
  logic verdict_prm_q, verdict_cfg_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {commit_init_q, commit_inputs_q, commit_diag_q, commit_c1_q, commit_c2_q, verdict_prm_q, verdict_cfg_q} <= 7'd0;
    end else begin
      commit_init_q <= state_i == SEQ_READ_LAST && item_i == ITEM_INIT;
      commit_inputs_q <= state_i == SEQ_READ_LAST && item_i == ITEM_INPUTS && initialised_i;
      commit_diag_q <= state_i == SEQ_READ_LAST && item_i == ITEM_DIAG && initialised_i;
      commit_c1_q <= state_i == SEQ_READ_LAST && item_i == ITEM_C1_ANSWER && initialised_i;
      commit_c2_q <= state_i == SEQ_READ_LAST && item_i == ITEM_C2_ANSWER && initialised_i;
      verdict_prm_q <= state_i == SEQ_VERDICT && item_i == ITEM_VERDICT_PRM;
      verdict_cfg_q <= state_i == SEQ_VERDICT && item_i == ITEM_VERDICT_CFG;
    end
  end
  assign commits = state_i == SEQ_COMMIT;
  assign readable = commits && !too_long_i;
  assign init_crc_right = commit_init_q && !crc_wrong_i;
  assign inputs_o.commit = commit_inputs_q && !crc_wrong_i;
  assign inputs_o.length = length_i;
  assign diagnosis_o.commit = commit_diag_q && !crc_wrong_i;
  assign diagnosis_o.kind = kind;
  assign diagnosis_o.present = type_q[7];
  assign diagnosis_o.length = length_i;
  assign answers_o.c1 = commit_c1_q && !crc_wrong_i;
  assign answers_o.c2 = commit_c2_q && !crc_wrong_i;
  assign answers_o.length = length_i;
  assign verdict_o.parameters = verdict_prm_q;
  assign verdict_o.configuration = verdict_cfg_q;
  assign verdict_o.wrong = verdict_wrong_q;

  logic reads_block;
  assign reads_block = is_user_block(item_i);
  assign judged_o = readable && reads_block && (item_i == ITEM_INIT || initialised_i);
  assign judged_init_o = commits && item_i == ITEM_INIT;
  assign init_limits_o = too_long_i || !crc_wrong_i;
  always_comb begin
    case (item_i)
      ITEM_INIT: error_bit_o = DSDPV1_REG_CHIP_STATUS_2_INIT_CRC;
      ITEM_INPUTS: error_bit_o = DSDPV1_REG_CHIP_STATUS_2_INPUT_CRC;
      ITEM_DIAG: error_bit_o = DSDPV1_REG_CHIP_STATUS_2_DIAG_CRC;
      ITEM_C1_ANSWER: error_bit_o = `FAULT(91) ? DSDPV1_REG_CHIP_STATUS_2_C2_CRC : DSDPV1_REG_CHIP_STATUS_2_C1_CRC;
      default: error_bit_o = DSDPV1_REG_CHIP_STATUS_2_C2_CRC;
    endcase
  end
endmodule
