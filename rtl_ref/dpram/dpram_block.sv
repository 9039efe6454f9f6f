// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The block that an item moves (9.3, 9.5): address of its next byte, address of its CRC, how many bytes are left, and which of them arrives.
//
// A byte that is read at one edge arrives at the next.
`include "dpram_types.svh"

module dpram_block (
  `FAULT_PORT
  input  logic        clk_i,
  input  logic        rst_ni,
  input  seq_t        state_i,
  input  item_t       item_i,
  input  item_t       pick_i,           // the item that the choice begins
  input  logic [10:0] first_addr_i,     // its first byte
  input  logic [7:0]  rdata_i,
  // mail
  input  dp_mail_t    mail_i,
  input  logic [7:0]  c1_length_i,
  input  logic [7:0]  c2_length_i,
  // where it is
  output logic [10:0] addr_o,           // of the next byte
  output logic [10:0] crc_addr_o,       // of the CRC's next byte
  output logic [7:0]  left_o,           // bytes after this one, while they move
  output logic        last_o,           // this byte is the last
  output logic        header_ends_o,    // the next byte is the length
  // the length byte, as it arrives
  output logic        empty_o,          // no data
  output logic        too_long_o,       // beyond the limit: nothing is read
  output logic        too_long_q_o,     // ... at the commit
  output logic [7:0]  length_o,         // of a block that is read; of the inputs in the configuration
  // the byte that arrives
  output logic        arrives_o,        // the CRC covers it
  output logic        stages_o,         // it is data
  output logic [7:0]  index_o           // its number; of an answer with its header, of others of the data
);
  logic chooses, data_moves;
  assign chooses = state_i == SEQ_CHOICE;
  assign data_moves = state_i == SEQ_READ_BYTES || state_i == SEQ_WRITE_BYTES;

  logic [7:0] prm_length, cfg_length, cfg_input_length, output_length;
  assign prm_length = mail_i.parameters.length;
  assign cfg_length = mail_i.configuration.length;
  assign cfg_input_length = mail_i.configuration.input_length;
  assign output_length = mail_i.outputs.length;

  // ---- addresses
  logic [10:0] addr_q, crc_addr, crc_addr_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) addr_q <= 11'd0;
    else if (chooses) addr_q <= first_addr_i + 11'd1;
    else if (state_i != SEQ_READ_LOOK) addr_q <= addr_q + 11'd1;
  end

  always_comb begin
    case (pick_i)
      ITEM_INIT: crc_addr = DSDPV1_REG_INIT_CRC;
      ITEM_INPUTS: crc_addr = DSDPV1_REG_INPUT_CRC;
      ITEM_DIAG: crc_addr = DSDPV1_REG_DIAG_CRC;
      ITEM_C1_ANSWER, ITEM_C1_REQUEST: crc_addr = DSDPV1_REG_C1_CRC;
      ITEM_C2_ANSWER, ITEM_C2_REQUEST: crc_addr = DSDPV1_REG_C2_CRC;
      ITEM_PRM: crc_addr = DSDPV1_REG_PRM_CRC;
      ITEM_CFG: crc_addr = DSDPV1_REG_CFG_CRC;
      default: crc_addr = DSDPV1_REG_OUTPUT_CRC;
    endcase
  end

  // Looked up at the choice, so that later states read a register; after the CRC's high byte the address of its low byte
  always_ff @(posedge clk_i) begin
    if (chooses) crc_addr_q <= crc_addr;
    else if (state_i == SEQ_READ_CRC_HIGH || state_i == SEQ_WRITE_CRC_HIGH) crc_addr_q <= crc_addr_q + 11'd1;
  end

  // ---- header of a block that is read: bytes of it after the next one
  logic [1:0] header_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) header_q <= 2'd0;
    else if (chooses) header_q <= pick_i == ITEM_DIAG ? 2'd0 : 2'd2;
    else if (state_i == SEQ_READ_HEADER) header_q <= header_q - 2'd1;
  end

  // A C1 or C2 answer has data after its four bytes only for some values of its Function_Num (V14)
  logic no_data_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) no_data_q <= 1'b0;
    else if (chooses) no_data_q <= 1'b0;
    else if (state_i == SEQ_READ_HEADER && header_q == 2'd2) no_data_q <= rdata_i != MSAC_READ && rdata_i != MSAC_TRANSPORT && !`FAULT(90);
  end

  // ---- length
  logic [7:0] limit, read_length, first_left, left_q, length_q;
  logic too_long, too_long_q;
  always_comb begin
    case (item_i)
      ITEM_INIT: limit = 8'd214;
      ITEM_INPUTS: limit = 8'd244;
      ITEM_DIAG: limit = 8'd238;
      default: limit = 8'd240;
    endcase
  end
  assign read_length = no_data_q ? 8'd0 : rdata_i;
  assign too_long = rdata_i > limit && !no_data_q && !`FAULT(50);

  // The choice writes the first byte of a request
  always_comb begin
    case (pick_i)
      ITEM_PRM: first_left = prm_length;
      ITEM_CFG: first_left = cfg_length;
      ITEM_C1_REQUEST: first_left = c1_length_i - 8'd1;
      ITEM_C2_REQUEST: first_left = c2_length_i - 8'd1;
      default: first_left = output_length;
    endcase
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) left_q <= 8'd0;
    else if (chooses) left_q <= first_left;
    else if (state_i == SEQ_READ_LOOK) left_q <= read_length;
    else if (data_moves) left_q <= left_q - 8'd1;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      length_q <= 8'd0;
      too_long_q <= 1'b0;
    end else if (chooses) begin
      length_q <= cfg_input_length;
      too_long_q <= 1'b0;
    end else if (state_i == SEQ_READ_LOOK) begin
      length_q <= read_length;
      too_long_q <= too_long;
    end
  end

  // ---- the byte that arrives
  logic answers, begins_read, arrives_q, stages_q;
  logic [7:0] index_q;
  assign answers = is_answer(item_i);
  assign begins_read = chooses && is_user_block(pick_i);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      arrives_q <= 1'b0;
      stages_q <= 1'b0;
    end else begin
      arrives_q <= begins_read || state_i == SEQ_READ_HEADER || state_i == SEQ_READ_BYTES;
      stages_q <= state_i == SEQ_READ_BYTES;
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) index_q <= 8'd0;
    else if (chooses) index_q <= 8'd0;
    else if (state_i == SEQ_READ_HEADER && answers) index_q <= index_q + 8'd1;
    else if (state_i == SEQ_READ_BYTES) index_q <= stages_q || answers ? index_q + 8'd1 : 8'd0;
  end

  assign addr_o = addr_q;
  assign crc_addr_o = crc_addr_q;
  assign left_o = left_q;
  assign last_o = left_q == 8'd1;
  assign header_ends_o = header_q == 2'd0;
  assign empty_o = read_length == 8'd0;
  assign too_long_o = too_long;
  assign too_long_q_o = too_long_q;
  assign length_o = length_q;
  assign arrives_o = arrives_q;
  assign stages_o = stages_q;
  assign index_o = index_q;
endmodule
