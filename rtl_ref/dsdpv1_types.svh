// Constants and functions shared by all blocks of the reference RTL. Words and numbers are those of docs/microarchitecture.md.
`ifndef DSDPV1_TYPES_SVH
`define DSDPV1_TYPES_SVH
`include "dsdpv1_regs.svh"
/* verilator lint_off UNUSED */

// Single faults for the test of the tests: one special build has an input fault_i that activates one of those listed in
// faults.txt. In every other build `FAULT(n) is 0 and the port does not exist.
`ifdef DSDPV1_FAULTS
`define FAULT_PORT input logic [7:0] fault_i,
`define FAULT_CONNECT .fault_i(fault_i),
`define FAULT(n) (fault_i == 8'd``n)
`else
`define FAULT_PORT
`define FAULT_CONNECT
`define FAULT(n) 1'b0
`endif

// The parameters of the rulings are inputs of the blocks, which the top ties to its parameters: constants for a synthesis. In a build
// with DSDPV1_RUN_TIME_LIMITS, for simulation only, the top has inputs instead, to be held during a run, and so one build serves for
// all values. `LIMIT(PARAMETER, port) is the one or the other.
`ifdef DSDPV1_RUN_TIME_LIMITS
`define LIMIT(parameter_name, port) port
`else
`define LIMIT(parameter_name, port) parameter_name
`endif

// Baud rates (S2): index 0 is 12 Mbit/s, 9 is 9.6 kbit/s.
localparam logic [3:0] RATE_LAST = 4'd9;

// Cycles of one bit (S2).
function automatic logic [12:0] bit_cycles(input logic [3:0] rate);
  case (rate)
    4'd0: bit_cycles = 13'd4;
    4'd1: bit_cycles = 13'd8;
    4'd2: bit_cycles = 13'd16;
    4'd3: bit_cycles = 13'd32;
    4'd4: bit_cycles = 13'd96;
    4'd5: bit_cycles = 13'd256;
    4'd6: bit_cycles = 13'd512;
    4'd7: bit_cycles = 13'd1056;
    4'd8: bit_cycles = 13'd2500;
    default: bit_cycles = 13'd5000;
  endcase
endfunction

// Greatest TSDR in bit times as far as min_TSDR, an 8-bit value, can exceed it (S11, 8.3).
function automatic logic [7:0] max_tsdr(input logic [3:0] rate);
  case (rate)
    4'd0, 4'd1: max_tsdr = 8'd255;
    4'd2, 4'd7: max_tsdr = 8'd250;
    4'd3: max_tsdr = 8'd150;
    4'd4: max_tsdr = 8'd100;
    default: max_tsdr = 8'd60;
  endcase
endfunction

// States of the DP slave, as in B012.
localparam logic [1:0] DP_OFFLINE = 2'd0;
localparam logic [1:0] DP_WAIT_PRM = 2'd1;
localparam logic [1:0] DP_WAIT_CFG = 2'd2;
localparam logic [1:0] DP_DATA_EXCH = 2'd3;

// Start delimiters of telegrams.
localparam logic [2:0] SD_SD1 = 3'd0;
localparam logic [2:0] SD_SD2 = 3'd1;
localparam logic [2:0] SD_SD3 = 3'd2;
localparam logic [2:0] SD_SD4 = 3'd3;
localparam logic [2:0] SD_SC = 3'd4;

// What an answer is.
localparam logic [2:0] ANS_NONE = 3'd0;
localparam logic [2:0] ANS_SC = 3'd1;
localparam logic [2:0] ANS_SD1 = 3'd2;
localparam logic [2:0] ANS_SD2 = 3'd3;
localparam logic [2:0] ANS_REPEAT = 3'd4;

// Function codes of answers.
localparam logic [7:0] FC_OK = 8'h00;
localparam logic [7:0] FC_RR = 8'h02;
localparam logic [7:0] FC_RS = 8'h03;
localparam logic [7:0] FC_DL = 8'h08;
localparam logic [7:0] FC_DH = 8'h0A;

// Where the data of an answer come from.
localparam logic [2:0] SRC_NONE = 3'd0;
localparam logic [2:0] SRC_INPUTS = 3'd1;
localparam logic [2:0] SRC_OUTPUTS = 3'd2;
localparam logic [2:0] SRC_CFG = 3'd3;
localparam logic [2:0] SRC_INIT_CFG = 3'd4;
localparam logic [2:0] SRC_DIAG = 3'd5;
localparam logic [2:0] SRC_MSAC = 3'd6;

// DPV1 (section 15): Function_Num that only the chip sees, and the codes of its abort PDU (V11, V12).
localparam logic [7:0] MSAC_IDLE = 8'h48;
localparam logic [7:0] MSAC_IMMEDIATE = 8'h56;
localparam logic [7:0] MSAC_INITIATE = 8'h57;
localparam logic [7:0] MSAC_ABORT = 8'h58;
localparam logic [3:0] ABORT_MSAC_C2 = 4'd1;   // Instance
localparam logic [2:0] ABORT_SEQUENCE = 3'd1;  // Reason
localparam logic [2:0] ABORT_INVALID_PDU = 3'd2;
localparam logic [2:0] ABORT_TIMEOUT = 3'd3;
localparam logic [2:0] ABORT_ADDRESS = 3'd7;

// Most data bytes of a request or an answer of the user.
localparam logic [7:0] MSAC_MAX_DATA = 8'd240;

// Who asks.
localparam logic [1:0] MSAC_C1 = 2'd0;
localparam logic [1:0] MSAC_30 = 2'd1;
localparam logic [1:0] MSAC_2F = 2'd2;

// What is wrong with a request or an Initiate (V9, V10).
localparam logic [1:0] MSAC_RIGHT = 2'd0;
localparam logic [1:0] MSAC_NOT_SUPPORTED = 2'd1;
localparam logic [1:0] MSAC_INVALID_PARAMETER = 2'd2;
localparam logic [1:0] MSAC_WRITE_LENGTH = 2'd3;

// Negative answer: Function_Num with bit 7, Error_Decode, Error_Code_1, Error_Code_2; the first lowest.
function automatic logic [31:0] negative_answer(input logic [7:0] function_num, input logic [1:0] code);
  case (code)
    MSAC_INVALID_PARAMETER: negative_answer = {16'h00B8, 8'h80, function_num | 8'h80};
    MSAC_WRITE_LENGTH: negative_answer = {16'h00B1, 8'h80, function_num | 8'h80};
    default: negative_answer = {16'h00A9, 8'h80, function_num | 8'h80};
  endcase
endfunction

// Abort PDU (V2, V11): Function_Num, Subnet, Instance and Reason; the first lowest.
function automatic logic [31:0] abort_pdu(input logic [2:0] reason);
  abort_pdu = {8'h00, ABORT_MSAC_C2, 1'b0, reason, 8'h00, MSAC_ABORT};
endfunction

// States of the watchdog (S1).
localparam logic [1:0] WD_OFF = 2'd0;
localparam logic [1:0] WD_BAUD_CONTROL = 2'd1;
localparam logic [1:0] WD_DP_CONTROL = 2'd2;

// What the sequencer does in an access, in the order of 9.2.
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

// Banks of the user-side pool of sap_buffers: inputs 0..3, diagnosis 4..7, configuration of the initialisation 8..9.
localparam logic [1:0] POOL_INPUTS = 2'd0;
localparam logic [1:0] POOL_DIAG = 2'd1;
localparam logic [1:0] POOL_INIT = 2'd2;

/* verilator lint_on UNUSED */
`endif
