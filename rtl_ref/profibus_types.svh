// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Constants, functions and bundles shared by the blocks of every DP slave chip (profibus/): the protocol, and the seam to the user's
// side. No address, size or register of a chip. Words and numbers are those of docs/microarchitecture.md.
`ifndef PROFIBUS_TYPES_SVH
`define PROFIBUS_TYPES_SVH

// Single faults for the test of the tests: one special build has an input fault_i that activates one of those listed in
// faults.txt. In every other build `FAULT(n) is 0 and the port does not exist.
`ifdef SINGLE_FAULTS
`define FAULT_PORT input logic [7:0] fault_i,
`define FAULT_CONNECT .fault_i(fault_i),
`define FAULT(n) (fault_i == 8'd``n)
`else
`define FAULT_PORT
`define FAULT_CONNECT
`define FAULT(n) 1'b0
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

// States of the DP slave.
localparam logic [1:0] DP_OFFLINE = 2'd0;
localparam logic [1:0] DP_WAIT_PRM = 2'd1;
localparam logic [1:0] DP_WAIT_CFG = 2'd2;
localparam logic [1:0] DP_DATA_EXCH = 2'd3;

// Service access points.
localparam logic [7:0] SAP_MSAC_2F = 8'd47;
localparam logic [7:0] SAP_MSAC_30 = 8'd48;
localparam logic [7:0] SAP_INITIATE = 8'd49;
localparam logic [7:0] SAP_MASTER_C2 = 8'd50;  // SSAP of a class 2 master
localparam logic [7:0] SAP_MSAC_C1 = 8'd51;    // DSAP, and SSAP of the class 1 master
localparam logic [7:0] SAP_SET_ADDRESS = 8'd55;
localparam logic [7:0] SAP_READ_INPUTS = 8'd56;
localparam logic [7:0] SAP_READ_OUTPUTS = 8'd57;
localparam logic [7:0] SAP_GLOBAL_CONTROL = 8'd58;
localparam logic [7:0] SAP_GET_CFG = 8'd59;
localparam logic [7:0] SAP_SLAVE_DIAG = 8'd60;
localparam logic [7:0] SAP_SET_PRM = 8'd61;
localparam logic [7:0] SAP_CHECK_CFG = 8'd62;

// The most bytes that a telegram to or from a SAP carries: data after the two SAPs; user parameters after the standard bytes of Set_Prm;
// data of a DPV1 PDU after its four bytes. A chip's capacity for the first two is a parameter of station, up to these values.
localparam logic [7:0] MOST_DATA = 8'd244;
localparam logic [7:0] MOST_PRM = 8'd237;
localparam logic [7:0] MOST_ACYCLIC = 8'd240;

// Start delimiters of telegrams.
localparam logic [2:0] SD_SD1 = 3'd0;
localparam logic [2:0] SD_SD2 = 3'd1;
localparam logic [2:0] SD_SD3 = 3'd2;
localparam logic [2:0] SD_SD4 = 3'd3;
localparam logic [2:0] SD_SC = 3'd4;

// The form of an answer.
localparam logic [2:0] ANS_NONE = 3'd0;
localparam logic [2:0] ANS_SC = 3'd1;
localparam logic [2:0] ANS_SD1 = 3'd2;
localparam logic [2:0] ANS_SD2 = 3'd3;

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

// DPV1 (section 15): Function_Num of requests, those that only the slave itself sees, and the codes of its abort PDU (V11, V12).
localparam logic [7:0] MSAC_TRANSPORT = 8'h51;  // class 2 only
localparam logic [7:0] MSAC_READ = 8'h5E;
localparam logic [7:0] MSAC_WRITE = 8'h5F;
localparam logic [7:0] MSAC_IDLE = 8'h48;
localparam logic [7:0] MSAC_IMMEDIATE = 8'h56;
localparam logic [7:0] MSAC_INITIATE = 8'h57;
localparam logic [7:0] MSAC_ABORT = 8'h58;
localparam logic [3:0] ABORT_MSAC_C2 = 4'd1;   // Instance
localparam logic [2:0] ABORT_SEQUENCE = 3'd1;  // Reason
localparam logic [2:0] ABORT_INVALID_PDU = 3'd2;
localparam logic [2:0] ABORT_TIMEOUT = 3'd3;
localparam logic [2:0] ABORT_ADDRESS = 3'd7;

// States of a channel of MSAC_C2 (15.2).
typedef enum logic [2:0] {
  C2_FREE = 3'd0,
  C2_INITIATED = 3'd1,
  C2_OPEN = 3'd2,
  C2_BUSY = 3'd3,
  C2_ANSWERED = 3'd4,
  C2_ABORTED = 3'd5
} channel_t;

// The requester in DPV1.
localparam logic [1:0] MSAC_C1 = 2'd0;
localparam logic [1:0] MSAC_30 = 2'd1;
localparam logic [1:0] MSAC_2F = 2'd2;

// Faults of a request or an Initiate (V9, V10).
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

// Banks of the user-side pool of sap_buffers: inputs 0..3, diagnosis 4..7, configuration of the initialisation 8..9.
localparam logic [1:0] POOL_INPUTS = 2'd0;
localparam logic [1:0] POOL_DIAG = 2'd1;
localparam logic [1:0] POOL_INIT = 2'd2;

// ---- inner bundles of the station

// Parameters of a Set_Prm (6.2.2).
typedef struct packed {
  logic       wd_on;
  logic [7:0] wd_factor_1;
  logic [7:0] wd_factor_2;
  logic       wd_base_1ms;
  logic [7:0] min_tsdr;
  logic [7:0] group;
  logic       sync_req;
  logic       freeze_req;
  logic       fail_safe;
  logic       dpv1;
} prm_t;

// The decision about a telegram (8.2).
typedef struct packed {
  logic execute;      // its service is executed at this edge
  logic refuse;       // it is one that is always refused
  logic fdl_status;
  logic srd;
  logic sdn;
  logic default_sap;
} service_t;

typedef struct packed {
  logic [2:0] kind;    // ANS_...
  logic [7:0] fc;
  logic [2:0] source;  // SRC_...
  logic [7:0] length;
} answer_t;

// Effects of a service on the DP slave at the edge of its execution (section 11).
typedef struct packed {
  logic good_prm;          // Set_Prm is right: mail, and ...
  logic accept_prm;        // ... in force at once, without a verdict of the user
  logic good_cfg;          // Check_Cfg likewise
  logic accept_cfg;
  logic min_tsdr_only;
  logic set_address;
  logic store;             // outputs
  logic clear;
  logic copy_outputs;
  logic copy_inputs;
  logic diag_read;         // by the holder
  logic enter_wait_prm;
  logic prm_fault;         // these are set
  logic cfg_fault;
  logic not_supported;
  logic global_control;    // one for this slave, and what it asks for
  logic sync;
  logic unsync;
  logic freeze;
  logic unfreeze;
} decision_t;

// ---- the user's side. Two bundles between station and the block that gives the user the bus: its commands and its inputs. Every
// command acts at the edge at which it is high; the inputs are registers.

// Kinds of the user's diagnosis (6.2.4).
localparam logic [1:0] DIAG_UNKNOWN = 2'd0;   // is not taken
localparam logic [1:0] DIAG_EXTENDED = 2'd1;  // low priority
localparam logic [1:0] DIAG_EXTERNAL = 2'd2;
localparam logic [1:0] DIAG_STATIC = 2'd3;

typedef struct packed {
  logic        commit;        // initialises, also again
  logic [6:0]  address;
  logic [15:0] ident;
  logic        fail_safe;     // functions that the slave supports: Fail_Safe, Sync, Freeze, Set_Slave_Address
  logic        sync;
  logic        freeze;
  logic        set_address;
  logic [7:0]  max_input;     // limits of what masters may configure
  logic [7:0]  max_output;
  logic [7:0]  max_diag;
  logic [7:0]  max_prm;
  logic [1:0]  prm_mode;      // who judges Set_Prm and Check_Cfg, and how (D8)
  logic [7:0]  max_cfg;
  logic [1:0]  cfg_mode;
  logic [7:0]  cfg_length;    // the configuration itself is staged before
  logic [7:0]  input_length;  // that it describes
  logic [7:0]  output_length;
} initialise_t;

typedef struct packed {
  logic parameters;     // on these
  logic configuration;
  logic wrong;
} verdict_t;

typedef struct packed {
  logic       commit;
  logic [7:0] length;
} inputs_t;

typedef struct packed {
  logic       commit;
  logic [1:0] kind;     // DIAG_...
  logic       present;  // else gone
  logic [7:0] length;
} diagnosis_t;

typedef struct packed {
  logic       c1;      // commits that of class 1
  logic       c2;
  logic [7:0] length;  // its data bytes
} answers_t;

// Blocks of the user on their way into buffers, before the commit.
typedef struct packed {
  logic       inputs;      // a block of these begins
  logic       diagnosis;
  logic       c1;
  logic       c2;
  logic       we;          // a byte of a block of the DP slave
  logic       acyclic_we;  // ... of an answer of DPV1
  logic [1:0] pool;        // POOL_...
  logic [7:0] index;
  logic [7:0] data;
} stage_t;

// Mail that is taken, byte by byte; user_hears_t.data is that byte at the next edge.
typedef struct packed {
  logic       parameters;
  logic       configuration;
  logic       outputs;
  logic       c1;
  logic       c2;
  logic [7:0] index;
} take_t;

typedef struct packed {
  initialise_t initialise;
  verdict_t    verdict;
  inputs_t     inputs;
  diagnosis_t  diagnosis;
  answers_t    answers;
  stage_t      stage;
  take_t       take;
  logic        dpv1_on;  // as long as it is high, DPV1 is served (D17)
} user_commands_t;

typedef struct packed {
  logic       waits;
  logic [7:0] length;
} mail_t;

typedef struct packed {
  logic       waits;
  logic [7:0] length;
  logic [7:0] input_length;  // that it describes
  logic [7:0] output_length;
} configuration_mail_t;

typedef struct packed {
  logic       waits;
  logic [7:0] function_num;  // the request's first byte
  logic [7:0] length;        // of the whole PDU
} acyclic_mail_t;

typedef struct packed {
  mail_t               parameters;
  configuration_mail_t configuration;
  mail_t               outputs;
} dp_mail_t;

typedef struct packed {
  logic        initialised;
  logic [1:0]  state;                   // DP_...
  logic [15:0] left;                    // how often DATA_EXCH was left (S18)
  logic [6:0]  address;                 // also a new one by Set_Slave_Address
  logic        global_control;          // one for this slave was decided at the last edge
  logic [7:0]  global_control_command;  // ... its Control_Command
} dp_status_t;

typedef struct packed {
  logic       found;  // else lost: it is searched
  logic [3:0] rate;
} baud_t;

typedef struct packed {
  dp_mail_t      mail;
  acyclic_mail_t c1;    // requests
  acyclic_mail_t c2;
  dp_status_t    status;
  baud_t         baud;
  logic [7:0]    data;  // of the mail that is being taken
} user_hears_t;

`endif
