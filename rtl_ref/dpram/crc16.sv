// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// CRC-16 of blocks in the DPRAM (4.2, D2): polynomial A001 reflected, one byte a cycle.
`include "dpram_types.svh"

module crc16 (
  input  logic [15:0] crc_i,
  input  logic [7:0]  byte_i,
  output logic [15:0] crc_o
);
  localparam logic [15:0] POLYNOMIAL = 16'hA001;

  function automatic logic [15:0] step(input logic [15:0] crc);
    step = {1'b0, crc[15:1]} ^ (crc[0] ? POLYNOMIAL : 16'h0000);
  endfunction

  assign crc_o = step(step(step(step(step(step(step(step(crc_i ^ {8'h00, byte_i}))))))));
endmodule
