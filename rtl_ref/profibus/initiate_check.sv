// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Checks Initiate (SAP 49; 15.2, V2, V10) while its bytes arrive. All results are registers that stand still before the decision.
`include "profibus_types.svh"

module initiate_check (
  `FAULT_PORT
  input  logic        clk_i,
  /* verilator lint_off UNUSEDSIGNAL */  // reserved bytes are ignored
  input  logic [63:0] head_i,       // first bytes of the telegram's data; reserved ones are ignored
  /* verilator lint_on UNUSEDSIGNAL */
  input  logic [7:0]  length_i,
  input  logic        valid_i,
  input  logic [7:0]  index_i,
  input  logic [7:0]  data_i,
  output logic        legal_o,      // else RS
  output logic [15:0] timeout_o,    // Send_Timeout, unit 10 ms
  output logic [1:0]  code_o,       // MSAC_..., what the poll will be answered
  output logic        long_o,       // Add_Addr with types and lengths
  output logic [7:0]  s_length_o,
  output logic [7:0]  d_length_o
);
  // Bytes of the PDU: 57, 3 reserved, Send_Timeout, Features, Profile_Features, Profile_Ident, then Add_Addr
  localparam logic [7:0] LEAST = 8'd14;        // with an Add_Addr of 2 bytes
  localparam logic [7:0] LONG_HEADER = 8'd16;  // with types and lengths
  localparam logic [7:0] S_LENGTH = 8'd13;
  localparam logic [7:0] D_LENGTH = 8'd15;

  logic [7:0] s_length_q, d_length_q;
  logic [8:0] long_length_q;
  logic is_short, is_long, features;
  assign is_short = length_i == LEAST;
  assign is_long =
`ifdef SINGLE_FAULTS
      (`FAULT(195) && length_i >= LONG_HEADER && long_length_q[7:0] == length_i - LONG_HEADER) ||
`endif
      length_i >= LONG_HEADER && (long_length_q == {1'b0, length_i - LONG_HEADER} || `FAULT(71));
  assign features = head_i[48] || `FAULT(70);  // DS_Read and DS_Write
  assign timeout_o = {head_i[39:32], head_i[47:40]};

  always_ff @(posedge clk_i) begin
    if (valid_i && index_i == S_LENGTH) s_length_q <= data_i;
    if (valid_i && index_i == D_LENGTH) d_length_q <= data_i;
    long_length_q <= {1'b0, s_length_q} + {1'b0, d_length_q};
    legal_o <= head_i[7:0] == MSAC_INITIATE && length_i >= LEAST && timeout_o != 16'd0;
    code_o <= !features ? MSAC_NOT_SUPPORTED : !is_short && !is_long ? MSAC_INVALID_PARAMETER : MSAC_RIGHT;
    long_o <= !is_short;
  end

  assign s_length_o = s_length_q;
  assign d_length_o = d_length_q;
endmodule
