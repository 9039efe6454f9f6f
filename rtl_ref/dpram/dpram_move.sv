// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The one byte that the sequencer moves at an edge (9.1 to 9.7): where, whether it is written, and what.
`include "dpram_types.svh"

module dpram_move (
  `FAULT_PORT
  input  logic [4:0]  state_i,        // SEQ_...
  input  logic [4:0]  item_i,         // ITEM_...
  input  logic [7:0]  u_i,            // copies of B010, B011, B00E, B00F (9.1)
  input  logic [7:0]  w_i,
  input  logic [7:0]  e_i,
  input  logic [7:0]  v_i,
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
  output logic [7:0]  u_without_o,    // the copies after the commit or flag of this item
  output logic [7:0]  w_without_o,
  output logic [7:0]  e_with_o,
  output logic [7:0]  v_with_o,
  output logic        we_o,
  output logic [10:0] addr_o,
  output logic [7:0]  wdata_o
);
  logic answer_item;
  logic [1:0] boot_low;
  logic [7:0] crc_high, crc_low;
  assign answer_item = item_i == ITEM_C1_ANSWER || item_i == ITEM_C2_ANSWER;
  assign boot_low = boot_i[1:0];
  assign {crc_high, crc_low} = crc_i;

  logic [7:0] version;
  logic request_item, c2_flag;
  assign request_item = item_i == ITEM_C1_REQUEST || item_i == ITEM_C2_REQUEST;
  assign c2_flag = item_i == ITEM_C2_REQUEST || `FAULT(88);
  assign w_without_o = w_i & (item_i == ITEM_C1_ANSWER ? 8'hFE : 8'hFD);
  assign v_with_o = v_i | (c2_flag ? DSDPV1_REG_CHIP_COMMAND_2_C2 : DSDPV1_REG_CHIP_COMMAND_2_C1);
  always_comb begin
    case (item_i)
      ITEM_INIT: u_without_o = u_i & 8'hFB;
      ITEM_VERDICT_PRM: u_without_o = u_i & 8'h7F;
      ITEM_VERDICT_CFG: u_without_o = u_i & 8'hBF;
      ITEM_INPUTS: u_without_o = u_i & 8'hFE;
      default: u_without_o = u_i & 8'hFD;
    endcase
    case (item_i)
      ITEM_PRM: e_with_o = e_i | DSDPV1_REG_CHIP_COMMAND_1_PRM;
      ITEM_CFG: e_with_o = e_i | DSDPV1_REG_CHIP_COMMAND_1_CFG;
      default: e_with_o = e_i | DSDPV1_REG_CHIP_COMMAND_1_OUTPUT;
    endcase
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
      SEQ_FLAGS_U: addr_o = DSDPV1_REG_USER_COMMAND_1;
      SEQ_FLAGS_U2: addr_o = DSDPV1_REG_USER_COMMAND_2;
      SEQ_FLAGS_E: addr_o = DSDPV1_REG_CHIP_COMMAND_1;
      SEQ_FLAGS_E2: addr_o = DSDPV1_REG_CHIP_COMMAND_2;
      SEQ_ENABLE: addr_o = DSDPV1_REG_DPV1_ENABLE;
      SEQ_CHOICE: begin
        we_o = first_we_i;
        addr_o = first_addr_i;
        wdata_o = first_wdata_i;
      end
      SEQ_COMMIT: begin
        we_o = !`FAULT(53);
        addr_o = answer_item ? DSDPV1_REG_USER_COMMAND_2 : DSDPV1_REG_USER_COMMAND_1;
        wdata_o = answer_item ? w_without_o : u_without_o;
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
        addr_o = request_item ? DSDPV1_REG_CHIP_COMMAND_2 : DSDPV1_REG_CHIP_COMMAND_1;
        wdata_o = request_item ? v_with_o : e_with_o;
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
