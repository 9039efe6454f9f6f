// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Memory of bytes with one write and one read port, both synchronous: inferred as block RAM. A byte that is written and read at the
// same edge is read as it was before.
`include "profibus_types.svh"

module buffer_ram #(
  parameter integer ADDRESS_BITS = 9,
  parameter integer BYTES = 512
) (
  input  logic                    clk_i,
  input  logic                    we_i,
  input  logic [ADDRESS_BITS-1:0] waddr_i,
  input  logic [7:0]              wdata_i,
  input  logic [ADDRESS_BITS-1:0] raddr_i,
  output logic [7:0]              rdata_o
);
  logic [7:0] memory_q [0:BYTES-1];

  always_ff @(posedge clk_i) begin
    if (we_i) memory_q[waddr_i] <= wdata_i;
    rdata_o <= memory_q[raddr_i];
  end
endmodule
