// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Checks a telegram to SAP 51, 48 or 47 (15; V9, V11): its kind, and whether a request is valid. The bytes stand still long before
// the decision: all results are registers.
`include "profibus_types.svh"

module request_check (
  `FAULT_PORT
  input  logic        clk_i,
  input  logic [7:0]  function_i,     // bytes of the telegram's data: Function_Num
  input  logic [7:0]  data_length_i,  // ... and the fourth
  input  logic [7:0]  length_i,       // how many there are
  output logic        poll_o,         // none
  output logic        abort_o,        // 58
  output logic        idle_o,         // 48
  output logic        initiate_o,     // 57
  output logic [1:0]  c1_code_o,      // MSAC_..., for class 1
  output logic        c2_right_o      // for class 2
);
  logic is_read, is_write, is_transport, read_wrong, write_wrong;
  assign is_read = function_i == MSAC_READ;
  assign is_write = function_i == MSAC_WRITE;
  assign is_transport = function_i == MSAC_TRANSPORT;
  assign read_wrong = length_i != 8'd4 || (data_length_i > MOST_ACYCLIC && `FAULT(67));
  assign write_wrong = length_i < 8'd4 || ({1'b0, length_i} != {1'b0, data_length_i} + 9'd4 && !`FAULT(68));

  logic [1:0] read_code, write_code;
  assign read_code = read_wrong ? MSAC_INVALID_PARAMETER : MSAC_RIGHT;
  assign write_code = write_wrong ? MSAC_WRITE_LENGTH : MSAC_RIGHT;

  always_ff @(posedge clk_i) begin
    poll_o <= length_i == 8'd0;
    abort_o <= function_i == MSAC_ABORT;
    idle_o <= function_i == MSAC_IDLE;
    initiate_o <= function_i == MSAC_INITIATE;
    c1_code_o <= is_read ? read_code : is_write || (is_transport && `FAULT(69)) ? write_code : MSAC_NOT_SUPPORTED;
    c2_right_o <= is_read ? !read_wrong : (is_write || is_transport) && !write_wrong;
  end
endmodule
