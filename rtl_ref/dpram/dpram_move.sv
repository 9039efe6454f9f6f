// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The one byte that the sequencer moves at an edge (9.1 to 9.7): where, whether it is written, and what.
`include "dpram_types.svh"

module dpram_move (
  `FAULT_PORT
  input  seq_t        state_i,
  input  item_t       item_i,
  input  logic [7:0]  user_flags_i,   // B010 or B011 as the commit of this item writes it
  input  logic [7:0]  chip_flags_i,   // B00E or B00F as the flag of this item writes it
  input  logic [10:0] boot_i,         // address of the start-up access
  input  logic        first_we_i,     // the first move of an item
  input  logic [10:0] first_addr_i,
  input  logic [7:0]  first_wdata_i,
  input  logic [10:0] addr_i,         // of a block's next byte
  input  logic [10:0] crc_addr_i,     // of the CRC's next byte
  input  logic [15:0] crc_i,
  input  logic [7:0]  length_i,       // length of the inputs in the configuration
  input  logic [7:0]  left_i,         // length of the configuration
  input  logic [7:0]  mail_data_i,    // the mail's next byte
  input  logic [7:0]  errors_i,       // B00B as it was read
  input  logic [7:0]  clear_i,        // bits of B00B to clear
  input  logic [7:0]  set_i,
  output logic        we_o,
  output logic [10:0] addr_o,
  output logic [7:0]  wdata_o
);
  logic answers, requests;
  assign answers = is_answer(item_i);
  assign requests = is_request(item_i);

  logic [1:0] boot_low;
  logic [7:0] crc_high, crc_low, version;
  assign boot_low = boot_i[1:0];
  assign {crc_high, crc_low} = crc_i;
  always_comb begin
    case (boot_low)
      2'd0: version = DSDPV1_REG_VERSION_RESET;
      2'd1: version = DSDPV1_REG_VERSION_YEAR_RESET;
      2'd2: version = DSDPV1_REG_VERSION_MONTH_RESET;
      default: version = DSDPV1_REG_VERSION_DAY_RESET;
    endcase
  end

  logic errors_both;
  logic [7:0] last_cleared;
  assign errors_both = `FAULT(51);
  assign last_cleared = `FAULT(103) ? clear_i : 8'h00;
  always_comb begin
    we_o = 1'b0;
    addr_o = addr_i;
    wdata_o = 8'h00;
    case (state_i)
      SEQ_CLEAR: begin
        we_o = 1'b1;
        addr_o = boot_i;
      end
      SEQ_VERSION: begin
        we_o = 1'b1;
        addr_o = boot_i;
        wdata_o = version;
      end
      SEQ_BOOT_COUNT, SEQ_COUNT: begin
        we_o = 1'b1;
        addr_o = DSDPV1_REG_ACCESS_COUNT;
        wdata_o = 8'h01;
      end
      SEQ_USER_1: addr_o = DSDPV1_REG_USER_COMMAND_1;
      SEQ_USER_2: addr_o = DSDPV1_REG_USER_COMMAND_2;
      SEQ_CHIP_1: addr_o = DSDPV1_REG_CHIP_COMMAND_1;
      SEQ_CHIP_2: addr_o = DSDPV1_REG_CHIP_COMMAND_2;
      SEQ_ENABLE: addr_o = DSDPV1_REG_DPV1_ENABLE;
      SEQ_CHOICE: begin
        we_o = first_we_i;
        addr_o = first_addr_i;
        wdata_o = first_wdata_i;
      end
      SEQ_COMMIT: begin
        we_o = !`FAULT(53);
        addr_o = answers ? DSDPV1_REG_USER_COMMAND_2 : DSDPV1_REG_USER_COMMAND_1;
        wdata_o = user_flags_i;
      end
      SEQ_WRITE_INPUT_LENGTH, SEQ_WRITE_LENGTH: begin
        we_o = 1'b1;
        wdata_o = state_i == SEQ_WRITE_INPUT_LENGTH ? length_i : left_i;
      end
      SEQ_WRITE_BYTES: begin
        we_o = 1'b1;
        wdata_o = mail_data_i;
      end
      SEQ_WRITE_CRC_HIGH: begin
        we_o = 1'b1;
        addr_o = crc_addr_i;
        wdata_o = crc_high;
      end
      SEQ_WRITE_CRC_LOW: begin
        we_o = !`FAULT(54);
        addr_o = crc_addr_i;
        wdata_o = crc_low;
      end
      SEQ_READ_CRC_HIGH, SEQ_READ_CRC_LOW: addr_o = crc_addr_i;
      SEQ_FLAG: begin
        we_o = 1'b1;
        addr_o = requests ? DSDPV1_REG_CHIP_COMMAND_2 : DSDPV1_REG_CHIP_COMMAND_1;
        wdata_o = chip_flags_i;
      end
      SEQ_ERRORS: begin
        we_o = 1'b1;
        addr_o = DSDPV1_REG_CHIP_STATUS_2;
        wdata_o = ((errors_both ? 8'd0 : errors_i & ~clear_i) | set_i) & ~last_cleared;
      end
      default: ;
    endcase
`ifdef SINGLE_FAULTS
    if (`FAULT(166) && state_i == SEQ_WRITE_CRC_HIGH) wdata_o = crc_low;
    if (`FAULT(166) && state_i == SEQ_WRITE_CRC_LOW) wdata_o = crc_high;
`endif
  end
endmodule
