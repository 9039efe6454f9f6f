// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Declarations shared by the DPRAM's blocks (dpram/): areas and registers of the user's side, independent of the user's port.
`ifndef DPRAM_TYPES_SVH
`define DPRAM_TYPES_SVH
`include "dsdpv1_regs.svh"
`include "profibus_types.svh"

// A chip may have ports with which the CRC of the user's blocks does not count: with DPRAM_CRC_MAY_NOT_COUNT defined ahead of this header the
// sequencer has an input that says whether it does. In every other build the port does not exist, and it counts.
`ifdef DPRAM_CRC_MAY_NOT_COUNT
`define CRC_COUNTS_PORT input logic crc_counts_i,
`define CONNECT_CRC_COUNTS .crc_counts_i(crc_counts_i),
`define AND_CRC_COUNTS && crc_counts_i
`else
`define CRC_COUNTS_PORT
`define CONNECT_CRC_COUNTS
`define AND_CRC_COUNTS
`endif

// The items of an access, in the order of 9.2.
localparam integer ITEMS = 20;
typedef enum logic [4:0] {
  ITEM_INIT = 5'd0,
  ITEM_VERDICT_PRM = 5'd1,
  ITEM_VERDICT_CFG = 5'd2,
  ITEM_HISTORY = 5'd3,  // B011.7: clearing of B00B.2 (D16)
  ITEM_INPUTS = 5'd4,
  ITEM_DIAG = 5'd5,
  ITEM_C1_ANSWER = 5'd6,
  ITEM_C2_ANSWER = 5'd7,
  ITEM_PRM = 5'd8,
  ITEM_CFG = 5'd9,
  ITEM_OUTPUTS = 5'd10,
  ITEM_C1_REQUEST = 5'd11,
  ITEM_C2_REQUEST = 5'd12,
  ITEM_VALID = 5'd13,
  ITEM_COUNT_HIGH = 5'd14,
  ITEM_COUNT_LOW = 5'd15,
  ITEM_STATUS_1 = 5'd16,
  ITEM_STATUS_2 = 5'd17,
  ITEM_STATUS_3 = 5'd18,
  ITEM_STATUS_4 = 5'd19,
  ITEM_NOTHING = 5'd20
} item_t;

// States of the sequencer.
typedef enum logic [4:0] {
  SEQ_RELEASED = 5'd0,  // from cycle R until the start-up access begins (H6)
  SEQ_CLEAR = 5'd1,
  SEQ_VERSION = 5'd2,
  SEQ_BOOT_COUNT = 5'd3,
  SEQ_BOOT_END = 5'd4,
  SEQ_IDLE = 5'd5,
  SEQ_COUNT = 5'd6,    // 9.1: s+1
  SEQ_USER_1 = 5'd7,   // s+2: reads B010
  SEQ_USER_2 = 5'd8,   // B011
  SEQ_CHIP_1 = 5'd9,   // B00E
  SEQ_CHIP_2 = 5'd10,  // B00F
  SEQ_ENABLE = 5'd11,  // B005
  SEQ_CHOICE = 5'd12,
  SEQ_READ_HEADER = 5'd13,  // 9.3: from the second byte on
  SEQ_READ_LOOK = 5'd14,
  SEQ_READ_BYTES = 5'd15,
  SEQ_READ_CRC_HIGH = 5'd16,
  SEQ_READ_CRC_LOW = 5'd17,
  SEQ_READ_LAST = 5'd18,
  SEQ_COMMIT = 5'd19,
  SEQ_VERDICT = 5'd20,
  SEQ_WRITE_INPUT_LENGTH = 5'd21,  // 9.5: header of the configuration
  SEQ_WRITE_LENGTH = 5'd22,
  SEQ_WRITE_BYTES = 5'd23,
  SEQ_WRITE_CRC_HIGH = 5'd24,
  SEQ_WRITE_CRC_LOW = 5'd25,
  SEQ_FLAG = 5'd26,
  SEQ_ERRORS = 5'd27  // second cycle of B00B
} seq_t;

// A block of C1 or C2: the user's answer, the master's request.
function automatic logic is_answer(input item_t item);
  is_answer = item == ITEM_C1_ANSWER || item == ITEM_C2_ANSWER;
endfunction
function automatic logic is_request(input item_t item);
  is_request = item == ITEM_C1_REQUEST || item == ITEM_C2_REQUEST;
endfunction

// A block that the user has written: the first move of its item is the read of its first byte.
function automatic logic is_user_block(input item_t item);
  is_user_block = item == ITEM_INIT || item == ITEM_INPUTS || item == ITEM_DIAG || item == ITEM_C1_ANSWER || item == ITEM_C2_ANSWER;
endfunction

`endif
