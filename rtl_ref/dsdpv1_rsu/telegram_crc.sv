// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The CRC of telegrams (R15): first over the request's bytes, then over its reply's.
`include "dsdpv1_rsu_types.svh"

module telegram_crc (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        take_i,        // a byte of a request, and whether it is the first
  input  logic        take_first_i,
  input  logic [7:0]  take_byte_i,
  input  logic        give_i,        // ... of a reply
  input  logic        give_first_i,
  input  logic [7:0]  give_byte_i,
  output logic [15:0] crc_o
);
  logic [15:0] crc_q, crc_before, crc_after;
  logic [7:0] data;
  assign crc_before = (give_i ? give_first_i : take_first_i) ? 16'hFFFF : crc_q;
  assign data = give_i ? give_byte_i : take_byte_i;
  crc16 u_crc (.crc_i(crc_before), .byte_i(data), .crc_o(crc_after));

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) crc_q <= 16'hFFFF;
    else if (give_i || take_i) crc_q <= crc_after;
  end
  assign crc_o = crc_q;
endmodule
