// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Generated from registers/dsdpv1.rdl by registers/generate.py. Do not edit.
// Addresses, bits and values of the DPRAM. A word (CRC, count) is at its high byte, the low byte follows.
`ifndef DSDPV1_REGS_SVH
`define DSDPV1_REGS_SVH
/* verilator lint_off UNUSED */

// DPRAM
localparam logic [11:0] DSDPV1_REG_DPRAM_SIZE = 12'd2048;  // bytes

// Status and command bytes
localparam logic [10:0] DSDPV1_REG_VERSION = 11'h0;  // Version code
localparam logic [7:0] DSDPV1_REG_VERSION_RESET = 8'h1;  // value after reset
localparam logic [10:0] DSDPV1_REG_VERSION_YEAR = 11'h1;  // Version, year
localparam logic [7:0] DSDPV1_REG_VERSION_YEAR_RESET = 8'hD;  // value after reset
localparam logic [10:0] DSDPV1_REG_VERSION_MONTH = 11'h2;  // Version, month
localparam logic [7:0] DSDPV1_REG_VERSION_MONTH_RESET = 8'h7;  // value after reset
localparam logic [10:0] DSDPV1_REG_VERSION_DAY = 11'h3;  // Version, day
localparam logic [7:0] DSDPV1_REG_VERSION_DAY_RESET = 8'h1;  // value after reset
localparam logic [10:0] DSDPV1_REG_VALID_FLAG = 11'h4;  // Valid flag
localparam logic [10:0] DSDPV1_REG_DPV1_ENABLE = 11'h5;  // DPV1 enable
localparam logic [10:0] DSDPV1_REG_ACCESS_COUNT = 11'h6;  // DPRAM access count
localparam logic [10:0] DSDPV1_REG_OFFLINE_COUNT = 11'h8;  // Count of leaving data exchange
localparam logic [10:0] DSDPV1_REG_CHIP_STATUS_1 = 11'hA;  // Chip status byte 1
localparam logic [7:0] DSDPV1_REG_CHIP_STATUS_1_INITIALISED = 8'h1;  // The initialisation succeeded; the user may clear it afterwards (ruling D7).
localparam logic [10:0] DSDPV1_REG_CHIP_STATUS_2 = 11'hB;  // Chip status byte 2
localparam logic [7:0] DSDPV1_REG_CHIP_STATUS_2_INIT_CRC = 8'h1;  // Initialisation data, CRC wrong.
localparam logic [7:0] DSDPV1_REG_CHIP_STATUS_2_V1_INIT_CRC = 8'h2;  // V1 initialisation, CRC wrong; the chip never sets it (ruling R5).
localparam logic [7:0] DSDPV1_REG_CHIP_STATUS_2_INPUT_CRC = 8'h4;  // Input data, CRC wrong.
localparam logic [7:0] DSDPV1_REG_CHIP_STATUS_2_DIAG_CRC = 8'h8;  // Diagnosis data, CRC wrong.
localparam logic [7:0] DSDPV1_REG_CHIP_STATUS_2_C1_CRC = 8'h10;  // C1 answer, CRC wrong.
localparam logic [7:0] DSDPV1_REG_CHIP_STATUS_2_C2_CRC = 8'h20;  // C2 answer, CRC wrong.
localparam logic [10:0] DSDPV1_REG_USER_STATUS_1 = 11'hC;  // User status byte 1
localparam logic [7:0] DSDPV1_REG_USER_STATUS_1_PRM_WRONG = 8'h1;  // The user judges the parameters wrong; counts with B010.7 (ruling D4).
localparam logic [7:0] DSDPV1_REG_USER_STATUS_1_CFG_WRONG = 8'h2;  // The user judges the configuration wrong; counts with B010.6 (ruling D4).
localparam logic [10:0] DSDPV1_REG_USER_STATUS_2 = 11'hD;  // User status byte 2
localparam logic [7:0] DSDPV1_REG_USER_STATUS_2_CFG_CRC = 8'h1;  // Configuration data, CRC wrong.
localparam logic [7:0] DSDPV1_REG_USER_STATUS_2_PRM_CRC = 8'h2;  // Parameter data, CRC wrong.
localparam logic [7:0] DSDPV1_REG_USER_STATUS_2_OUTPUT_CRC = 8'h4;  // Output data, CRC wrong.
localparam logic [7:0] DSDPV1_REG_USER_STATUS_2_C2_CRC = 8'h8;  // C2 request, CRC wrong.
localparam logic [7:0] DSDPV1_REG_USER_STATUS_2_C1_CRC = 8'h10;  // C1 request, CRC wrong.
localparam logic [10:0] DSDPV1_REG_CHIP_COMMAND_1 = 11'hE;  // Chip command byte 1
localparam logic [7:0] DSDPV1_REG_CHIP_COMMAND_1_OUTPUT = 8'h1;  // Output data valid.
localparam logic [7:0] DSDPV1_REG_CHIP_COMMAND_1_PRM = 8'h2;  // Parameter data valid.
localparam logic [7:0] DSDPV1_REG_CHIP_COMMAND_1_CFG = 8'h4;  // Configuration data valid.
localparam logic [10:0] DSDPV1_REG_CHIP_COMMAND_2 = 11'hF;  // Chip command byte 2
localparam logic [7:0] DSDPV1_REG_CHIP_COMMAND_2_C1 = 8'h1;  // C1 request valid.
localparam logic [7:0] DSDPV1_REG_CHIP_COMMAND_2_C2 = 8'h2;  // C2 request valid.
localparam logic [10:0] DSDPV1_REG_USER_COMMAND_1 = 11'h10;  // User command byte 1
localparam logic [7:0] DSDPV1_REG_USER_COMMAND_1_INPUT = 8'h1;  // Input data valid.
localparam logic [7:0] DSDPV1_REG_USER_COMMAND_1_DIAG = 8'h2;  // Diagnosis data valid.
localparam logic [7:0] DSDPV1_REG_USER_COMMAND_1_INIT = 8'h4;  // Initialisation data valid.
localparam logic [7:0] DSDPV1_REG_USER_COMMAND_1_CFG_VERDICT = 8'h40;  // Verdict on the configuration valid, see B00C.1 (ruling D4).
localparam logic [7:0] DSDPV1_REG_USER_COMMAND_1_PRM_VERDICT = 8'h80;  // Verdict on the parameters valid, see B00C.0 (ruling D4).
localparam logic [10:0] DSDPV1_REG_USER_COMMAND_2 = 11'h11;  // User command byte 2
localparam logic [7:0] DSDPV1_REG_USER_COMMAND_2_C1 = 8'h1;  // C1 answer valid.
localparam logic [7:0] DSDPV1_REG_USER_COMMAND_2_C2 = 8'h2;  // C2 answer valid.
localparam logic [7:0] DSDPV1_REG_USER_COMMAND_2_INPUT_HISTORY = 8'h40;  // 1: B00B.2 shows the history of the inputs' CRC, a right block does not clear it; 0: the present. The user sets and clears it, the chip only reads it (ruling D16).
localparam logic [7:0] DSDPV1_REG_USER_COMMAND_2_INPUT_CLEAR = 8'h80;  // Asks the chip to clear B00B.2, which it does once when B011.6 is 1; it sets this bit back to 0 whatever B011.6 is (ruling D16).
localparam logic [10:0] DSDPV1_REG_CHIP_STATUS_3 = 11'h12;  // Chip status byte 3
localparam logic [7:0] DSDPV1_REG_CHIP_STATUS_3_DP_STATE = 8'hC;  // State of the DP slave.
localparam logic [2:0] DSDPV1_REG_CHIP_STATUS_3_DP_STATE_SHIFT = 3'd2;  // lowest bit
localparam logic [7:0] DSDPV1_REG_CHIP_STATUS_3_BAUD_RATE = 8'hF0;  // Baud rate.
localparam logic [2:0] DSDPV1_REG_CHIP_STATUS_3_BAUD_RATE_SHIFT = 3'd4;  // lowest bit
localparam logic [10:0] DSDPV1_REG_CHIP_STATUS_4 = 11'h13;  // Chip status byte 4
localparam logic [7:0] DSDPV1_REG_CHIP_STATUS_4_INIT_LIMIT = 8'h1;  // A length or the address of the initialisation is out of its limits (ruling D7).
localparam logic [7:0] DSDPV1_REG_CHIP_STATUS_4_C2_LIMIT = 8'h2;  // Number of C2 channels over its limit; always 0 (ruling R5).
localparam logic [7:0] DSDPV1_REG_CHIP_STATUS_4_SLOT_LIMIT = 8'h4;  // Number of slots and indices over its limit; always 0 (ruling R5).
localparam logic [10:0] DSDPV1_REG_OWNERSHIP = 11'h14;  // Ownership
localparam logic [7:0] DSDPV1_REG_OWNERSHIP_CHIP = 8'h1;  // The chip is in an access.
localparam logic [7:0] DSDPV1_REG_OWNERSHIP_HOST = 8'h2;  // The host is in an access.
localparam logic [10:0] DSDPV1_REG_U_TIMER = 11'h15;  // U_Timer
localparam logic [7:0] DSDPV1_REG_U_TIMER_ENABLE = 8'h1;  // Enabled: the ownership ends automatically.
localparam logic [10:0] DSDPV1_REG_UART_INTERVAL = 11'h19;  // Interval between characters
localparam logic [10:0] DSDPV1_REG_UART_TSDR = 11'h1A;  // TSDR

// Initialisation data
localparam logic [10:0] DSDPV1_REG_INIT = 11'h20;  // first byte
localparam logic [11:0] DSDPV1_REG_INIT_SIZE = 12'd215;  // bytes, without the CRC
localparam logic [10:0] DSDPV1_REG_INIT_LENGTH = 11'h20;  // Length
localparam logic [10:0] DSDPV1_REG_INIT_ADDRESS = 11'h21;  // Station address
localparam logic [7:0] DSDPV1_REG_INIT_ADDRESS_LIMIT = 8'd126;  // largest value accepted
localparam logic [10:0] DSDPV1_REG_INIT_IDENT_HIGH = 11'h22;  // Ident number, high byte
localparam logic [10:0] DSDPV1_REG_INIT_IDENT_LOW = 11'h23;  // Ident number, low byte
localparam logic [10:0] DSDPV1_REG_INIT_COMMAND = 11'h24;  // Initialisation command byte
localparam logic [7:0] DSDPV1_REG_INIT_COMMAND_ADDRESS_CHANGE = 8'h1;  // Set_Slave_Address is supported.
localparam logic [7:0] DSDPV1_REG_INIT_COMMAND_FREEZE = 8'h2;  // Freeze is supported.
localparam logic [7:0] DSDPV1_REG_INIT_COMMAND_SYNC = 8'h4;  // Sync is supported.
localparam logic [7:0] DSDPV1_REG_INIT_COMMAND_FAIL_SAFE = 8'h8;  // Fail-safe mode is supported.
localparam logic [10:0] DSDPV1_REG_INIT_MAX_INPUT = 11'h27;  // Largest input data length
localparam logic [7:0] DSDPV1_REG_INIT_MAX_INPUT_LIMIT = 8'd244;  // largest value accepted
localparam logic [10:0] DSDPV1_REG_INIT_MAX_OUTPUT = 11'h28;  // Largest output data length
localparam logic [7:0] DSDPV1_REG_INIT_MAX_OUTPUT_LIMIT = 8'd244;  // largest value accepted
localparam logic [10:0] DSDPV1_REG_INIT_MAX_DIAG = 11'h29;  // User diagnosis length
localparam logic [7:0] DSDPV1_REG_INIT_MAX_DIAG_LIMIT = 8'd238;  // largest value accepted
localparam logic [10:0] DSDPV1_REG_INIT_MAX_PRM = 11'h2A;  // Largest user parameter length
localparam logic [7:0] DSDPV1_REG_INIT_MAX_PRM_LIMIT = 8'd237;  // largest value accepted
localparam logic [10:0] DSDPV1_REG_PRM_MODE = 11'h2B;  // Judging mode of the user parameters
localparam logic [10:0] DSDPV1_REG_INIT_MAX_CFG = 11'h2C;  // Largest configuration length
localparam logic [7:0] DSDPV1_REG_INIT_MAX_CFG_LIMIT = 8'd200;  // largest value accepted
localparam logic [10:0] DSDPV1_REG_CFG_MODE = 11'h2D;  // Judging mode of the configuration
localparam logic [10:0] DSDPV1_REG_INIT_CFG_LENGTH = 11'h2E;  // Configuration length
localparam logic [7:0] DSDPV1_REG_INIT_CFG_LENGTH_LIMIT = 8'd200;  // largest value accepted
localparam logic [10:0] DSDPV1_REG_INIT_CFG = 11'h2F;  // Configuration bytes
localparam logic [11:0] DSDPV1_REG_INIT_CFG_SIZE = 12'd200;  // bytes
localparam logic [10:0] DSDPV1_REG_INIT_CRC = 11'hF7;  // CRC

// Input data
localparam logic [10:0] DSDPV1_REG_INPUT = 11'h130;  // first byte
localparam logic [11:0] DSDPV1_REG_INPUT_SIZE = 12'd245;  // bytes, without the CRC
localparam logic [10:0] DSDPV1_REG_INPUT_LENGTH = 11'h130;  // Length
localparam logic [10:0] DSDPV1_REG_INPUT_DATA = 11'h131;  // Input bytes
localparam logic [11:0] DSDPV1_REG_INPUT_DATA_SIZE = 12'd244;  // bytes
localparam logic [10:0] DSDPV1_REG_INPUT_CRC = 11'h225;  // CRC

// Diagnosis data
localparam logic [10:0] DSDPV1_REG_DIAG = 11'h227;  // first byte
localparam logic [11:0] DSDPV1_REG_DIAG_SIZE = 12'd240;  // bytes, without the CRC
localparam logic [10:0] DSDPV1_REG_DIAG_TYPE = 11'h227;  // Type of diagnosis
localparam logic [10:0] DSDPV1_REG_DIAG_LENGTH = 11'h228;  // Length
localparam logic [10:0] DSDPV1_REG_DIAG_DATA = 11'h229;  // Diagnosis bytes
localparam logic [11:0] DSDPV1_REG_DIAG_DATA_SIZE = 12'd238;  // bytes
localparam logic [10:0] DSDPV1_REG_DIAG_CRC = 11'h317;  // CRC

// Output data
localparam logic [10:0] DSDPV1_REG_OUTPUT = 11'h319;  // first byte
localparam logic [11:0] DSDPV1_REG_OUTPUT_SIZE = 12'd245;  // bytes, without the CRC
localparam logic [10:0] DSDPV1_REG_OUTPUT_LENGTH = 11'h319;  // Length
localparam logic [10:0] DSDPV1_REG_OUTPUT_DATA = 11'h31A;  // Output bytes
localparam logic [11:0] DSDPV1_REG_OUTPUT_DATA_SIZE = 12'd244;  // bytes
localparam logic [10:0] DSDPV1_REG_OUTPUT_CRC = 11'h40E;  // CRC

// User parameters
localparam logic [10:0] DSDPV1_REG_PRM = 11'h410;  // first byte
localparam logic [11:0] DSDPV1_REG_PRM_SIZE = 12'd238;  // bytes, without the CRC
localparam logic [10:0] DSDPV1_REG_PRM_LENGTH = 11'h410;  // Length
localparam logic [10:0] DSDPV1_REG_PRM_DATA = 11'h411;  // User parameter bytes
localparam logic [11:0] DSDPV1_REG_PRM_DATA_SIZE = 12'd237;  // bytes
localparam logic [10:0] DSDPV1_REG_PRM_CRC = 11'h4FE;  // CRC

// Configuration
localparam logic [10:0] DSDPV1_REG_CFG = 11'h500;  // first byte
localparam logic [11:0] DSDPV1_REG_CFG_SIZE = 12'd203;  // bytes, without the CRC
localparam logic [10:0] DSDPV1_REG_CFG_OUTPUT_LENGTH = 11'h500;  // Output data length
localparam logic [10:0] DSDPV1_REG_CFG_INPUT_LENGTH = 11'h501;  // Input data length
localparam logic [10:0] DSDPV1_REG_CFG_LENGTH = 11'h502;  // Length
localparam logic [10:0] DSDPV1_REG_CFG_DATA = 11'h503;  // Configuration bytes
localparam logic [11:0] DSDPV1_REG_CFG_DATA_SIZE = 12'd200;  // bytes
localparam logic [10:0] DSDPV1_REG_CFG_CRC = 11'h5CB;  // CRC

// Non-cyclic data, class 1
localparam logic [10:0] DSDPV1_REG_C1 = 11'h5D0;  // first byte
localparam logic [11:0] DSDPV1_REG_C1_SIZE = 12'd244;  // bytes, without the CRC
localparam logic [10:0] DSDPV1_REG_C1_FUNCTION_NUM = 11'h5D0;  // Function_Num
localparam logic [10:0] DSDPV1_REG_C1_SLOT = 11'h5D1;  // Slot number or Error_Decode
localparam logic [10:0] DSDPV1_REG_C1_INDEX = 11'h5D2;  // Index or Error_Code_1
localparam logic [10:0] DSDPV1_REG_C1_LENGTH = 11'h5D3;  // Data length or Error_Code_2
localparam logic [10:0] DSDPV1_REG_C1_DATA = 11'h5D4;  // Data
localparam logic [11:0] DSDPV1_REG_C1_DATA_SIZE = 12'd240;  // bytes
localparam logic [10:0] DSDPV1_REG_C1_CRC = 11'h6C4;  // CRC

// Non-cyclic data, class 2
localparam logic [10:0] DSDPV1_REG_C2 = 11'h6D0;  // first byte
localparam logic [11:0] DSDPV1_REG_C2_SIZE = 12'd244;  // bytes, without the CRC
localparam logic [10:0] DSDPV1_REG_C2_FUNCTION_NUM = 11'h6D0;  // Function_Num
localparam logic [10:0] DSDPV1_REG_C2_SLOT = 11'h6D1;  // Slot number or Error_Decode
localparam logic [10:0] DSDPV1_REG_C2_INDEX = 11'h6D2;  // Index or Error_Code_1
localparam logic [10:0] DSDPV1_REG_C2_LENGTH = 11'h6D3;  // Data length or Error_Code_2
localparam logic [10:0] DSDPV1_REG_C2_DATA = 11'h6D4;  // Data
localparam logic [11:0] DSDPV1_REG_C2_DATA_SIZE = 12'd240;  // bytes
localparam logic [10:0] DSDPV1_REG_C2_CRC = 11'h7C4;  // CRC

// Values of valid_flag
localparam logic [7:0] DSDPV1_REG_VALID_FLAG_VALID = 8'hC5;  // The chip has begun to work.

// Values of dpv1_enable
localparam logic [7:0] DSDPV1_REG_DPV1_ENABLE_ON = 8'h1D;  // DPV1 is enabled; every other value disables it.

// Values of dp_state
localparam logic [7:0] DSDPV1_REG_DP_STATE_OFFLINE = 8'h0;  // OFFLINE
localparam logic [7:0] DSDPV1_REG_DP_STATE_WAIT_PRM = 8'h1;  // WAIT_PRM
localparam logic [7:0] DSDPV1_REG_DP_STATE_WAIT_CFG = 8'h2;  // WAIT_CFG
localparam logic [7:0] DSDPV1_REG_DP_STATE_DATA_EXCHANGE = 8'h3;  // DATA_EXCHANGE

// Values of baud
localparam logic [7:0] DSDPV1_REG_BAUD_RATE_12M = 8'h0;  // 12 Mbit/s
localparam logic [7:0] DSDPV1_REG_BAUD_RATE_6M = 8'h1;  // 6 Mbit/s
localparam logic [7:0] DSDPV1_REG_BAUD_RATE_3M = 8'h2;  // 3 Mbit/s
localparam logic [7:0] DSDPV1_REG_BAUD_RATE_1M5 = 8'h3;  // 1.5 Mbit/s
localparam logic [7:0] DSDPV1_REG_BAUD_RATE_500K = 8'h4;  // 500 kbit/s
localparam logic [7:0] DSDPV1_REG_BAUD_RATE_187K5 = 8'h5;  // 187.5 kbit/s
localparam logic [7:0] DSDPV1_REG_BAUD_RATE_93K75 = 8'h6;  // 93.75 kbit/s
localparam logic [7:0] DSDPV1_REG_BAUD_RATE_45K45 = 8'h7;  // 45.45 kbit/s
localparam logic [7:0] DSDPV1_REG_BAUD_RATE_19K2 = 8'h8;  // 19.2 kbit/s
localparam logic [7:0] DSDPV1_REG_BAUD_RATE_9K6 = 8'h9;  // 9.6 kbit/s
localparam logic [7:0] DSDPV1_REG_BAUD_SEARCHING = 8'hF;  // The baud rate is being searched.

// Values of prm_mode
localparam logic [7:0] DSDPV1_REG_PRM_MODE_AT_MOST = 8'h0;  // The chip judges: user parameter length <= B02A.
localparam logic [7:0] DSDPV1_REG_PRM_MODE_EXACTLY = 8'h1;  // The chip judges: user parameter length = B02A.
localparam logic [7:0] DSDPV1_REG_PRM_MODE_USER = 8'h2;  // The user judges: verdict in B00C.0, handed over with B010.7.

// Values of cfg_mode
localparam logic [7:0] DSDPV1_REG_CFG_MODE_AT_MOST = 8'h0;  // The chip judges: 0 < configuration length <= B02C.
localparam logic [7:0] DSDPV1_REG_CFG_MODE_EQUAL = 8'h1;  // The chip judges: configuration equal to B02F.. of the initialisation.
localparam logic [7:0] DSDPV1_REG_CFG_MODE_USER = 8'h2;  // The user judges: verdict in B00C.1, handed over with B010.6.

// Values of diag_type
localparam logic [7:0] DSDPV1_REG_DIAG_TYPE_EXTENDED = 8'h0;  // Low priority, extended diagnosis; ends external diagnosis (Ext_Diag 0).
localparam logic [7:0] DSDPV1_REG_DIAG_TYPE_EXTERNAL_GONE = 8'h1;  // High priority, external diagnosis: the station has no error.
localparam logic [7:0] DSDPV1_REG_DIAG_TYPE_EXTERNAL_PRESENT = 8'h81;  // High priority, external diagnosis: the station has an error (Ext_Diag).
localparam logic [7:0] DSDPV1_REG_DIAG_TYPE_STATIC_GONE = 8'h2;  // High priority, static diagnosis: the station has no error.
localparam logic [7:0] DSDPV1_REG_DIAG_TYPE_STATIC_PRESENT = 8'h82;  // High priority, static diagnosis: the station has an error (Stat_Diag).

// Values of function_num
localparam logic [7:0] DSDPV1_REG_FUNCTION_NUM_TRANSPORT = 8'h51;  // DS_Transport, class 2 only (table 31).
localparam logic [7:0] DSDPV1_REG_FUNCTION_NUM_READ = 8'h5E;  // DS_Read (table 26).
localparam logic [7:0] DSDPV1_REG_FUNCTION_NUM_WRITE = 8'h5F;  // DS_Write (table 26).
localparam logic [7:0] DSDPV1_REG_FUNCTION_NUM_TRANSPORT_ERROR = 8'hD1;  // Transport error, class 2 only (table 32).
localparam logic [7:0] DSDPV1_REG_FUNCTION_NUM_READ_ERROR = 8'hDE;  // Read error (table 27).
localparam logic [7:0] DSDPV1_REG_FUNCTION_NUM_WRITE_ERROR = 8'hDF;  // Write error (table 27).

/* verilator lint_on UNUSED */
`endif
