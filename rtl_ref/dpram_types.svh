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
`define AND_CRC_COUNTS && crc_counts_i
`else
`define CRC_COUNTS_PORT
`define AND_CRC_COUNTS
`endif
/* verilator lint_off UNUSED */

// The items of an access, in the order of 9.2.
localparam integer ITEMS = 20;
localparam logic [4:0] ITEM_INIT = 5'd0;
localparam logic [4:0] ITEM_VERDICT_PRM = 5'd1;
localparam logic [4:0] ITEM_VERDICT_CFG = 5'd2;
localparam logic [4:0] ITEM_HISTORY = 5'd3;  // B011.7: clearing of B00B.2 (D16)
localparam logic [4:0] ITEM_INPUTS = 5'd4;
localparam logic [4:0] ITEM_DIAG = 5'd5;
localparam logic [4:0] ITEM_C1_ANSWER = 5'd6;
localparam logic [4:0] ITEM_C2_ANSWER = 5'd7;
localparam logic [4:0] ITEM_PRM = 5'd8;
localparam logic [4:0] ITEM_CFG = 5'd9;
localparam logic [4:0] ITEM_OUTPUTS = 5'd10;
localparam logic [4:0] ITEM_C1_REQUEST = 5'd11;
localparam logic [4:0] ITEM_C2_REQUEST = 5'd12;
localparam logic [4:0] ITEM_VALID = 5'd13;
localparam logic [4:0] ITEM_COUNT_HIGH = 5'd14;
localparam logic [4:0] ITEM_COUNT_LOW = 5'd15;
localparam logic [4:0] ITEM_STATUS_1 = 5'd16;
localparam logic [4:0] ITEM_STATUS_2 = 5'd17;
localparam logic [4:0] ITEM_STATUS_3 = 5'd18;
localparam logic [4:0] ITEM_STATUS_4 = 5'd19;
localparam logic [4:0] ITEM_NOTHING = 5'd20;

// States of the sequencer.
localparam logic [4:0] SEQ_RELEASED = 5'd0;    // from cycle R until the start-up access begins (H6)
localparam logic [4:0] SEQ_CLEAR = 5'd1;
localparam logic [4:0] SEQ_VERSION = 5'd2;
localparam logic [4:0] SEQ_BOOT_COUNT = 5'd3;
localparam logic [4:0] SEQ_BOOT_END = 5'd4;
localparam logic [4:0] SEQ_IDLE = 5'd5;
localparam logic [4:0] SEQ_COUNT = 5'd6;       // 9.1: s+1
localparam logic [4:0] SEQ_FLAGS_U = 5'd7;
localparam logic [4:0] SEQ_FLAGS_U2 = 5'd8;
localparam logic [4:0] SEQ_FLAGS_E = 5'd9;
localparam logic [4:0] SEQ_FLAGS_E2 = 5'd10;
localparam logic [4:0] SEQ_ENABLE = 5'd11;
localparam logic [4:0] SEQ_CHOICE = 5'd12;
localparam logic [4:0] SEQ_READ_HEADER = 5'd13;  // 9.3: from the second byte on
localparam logic [4:0] SEQ_READ_LOOK = 5'd14;
localparam logic [4:0] SEQ_READ_BYTES = 5'd15;
localparam logic [4:0] SEQ_READ_CRC_HIGH = 5'd16;
localparam logic [4:0] SEQ_READ_CRC_LOW = 5'd17;
localparam logic [4:0] SEQ_READ_LAST = 5'd18;
localparam logic [4:0] SEQ_COMMIT = 5'd19;
localparam logic [4:0] SEQ_VERDICT = 5'd20;
localparam logic [4:0] SEQ_WRITE_INPUT_LENGTH = 5'd21;  // 9.5: header of the configuration
localparam logic [4:0] SEQ_WRITE_LENGTH = 5'd22;
localparam logic [4:0] SEQ_WRITE_BYTES = 5'd23;
localparam logic [4:0] SEQ_WRITE_CRC_HIGH = 5'd24;
localparam logic [4:0] SEQ_WRITE_CRC_LOW = 5'd25;
localparam logic [4:0] SEQ_FLAG = 5'd26;
localparam logic [4:0] SEQ_ERRORS = 5'd27;       // second cycle of B00B

/* verilator lint_on UNUSED */
`endif
