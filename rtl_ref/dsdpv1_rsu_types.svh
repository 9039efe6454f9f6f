// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Declarations shared by the blocks of DSDPV1-RSU's serial ports (dsdpv1_rsu/), in addition to the DSDPV1's. Words are those of
// docs/microarchitecture_rsu.md, whose sections are meant by the numbers in these blocks.
`ifndef DSDPV1_RSU_TYPES_SVH
`define DSDPV1_RSU_TYPES_SVH
`define DPRAM_CRC_MAY_NOT_COUNT  // SP15; therefore this header is the first of dsdpv1_rsu/files.txt
`include "dsdpv1_types.svh"

// MODE (R11); 00 and 11 are parallel.
localparam logic [1:0] MODE_SPI = 2'b01;
localparam logic [1:0] MODE_UART = 2'b10;

// The request of a telegram, bits 7..5 of its first byte: 2 is SPI's read and write, and UART's exchange.
localparam logic [1:0] ASK_READ = 2'd0;
localparam logic [1:0] ASK_WRITE = 2'd1;
localparam logic [1:0] ASK_EXCHANGE = 2'd2;

// Registers that only this chip has.
localparam logic [10:0] RSU_REG_OWNERSHIP = 11'h014;
localparam logic [10:0] RSU_REG_U_TIMER = 11'h015;
localparam logic [10:0] RSU_REG_UART_INTERVAL = 11'h019;
localparam logic [10:0] RSU_REG_UART_TSDR = 11'h01A;

// Where an exchange goes (UA9), the high bit chooses B010 or B011, the low one the bit in it.
localparam logic [1:0] TO_INPUTS = 2'd0;
localparam logic [1:0] TO_DIAGNOSIS = 2'd1;
localparam logic [1:0] TO_C1 = 2'd2;
localparam logic [1:0] TO_C2 = 2'd3;

// The area that an exchange replies (6.4).
typedef enum logic [2:0] {
  AREA_OUTPUTS = 3'd0,
  AREA_PARAMETERS = 3'd1,
  AREA_CONFIGURATION = 3'd2,
  AREA_C1 = 3'd3,
  AREA_C2 = 3'd4
} area_t;

// A telegram as it is judged, from registers.
typedef struct packed {
  logic [1:0]  ask;            // ASK_...
  logic [10:0] address;
  logic [7:0]  length;         // its length byte
  logic [1:0]  area;           // TO_...
  logic        crc_wrong;
  logic        address_wrong;
  logic        data_wrong;
  logic        length_wrong;
  logic        covers;         // a write that covers B014
  logic        claims;         // ... bit 1 of that byte
} telegram_t;

// Its outcome, at the edge of its judgement.
typedef struct packed {
  logic       replies;     // also with an error
  logic       refused;     // error, or B014 does not allow it
  logic [3:0] code;        // error code
  logic       crc_right;
  logic       commits;
  logic       owns;        // B014.1 is set or cleared
} judgement_t;

`endif
