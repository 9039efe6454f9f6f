// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Data of a telegram and, with UART, of its reply, as block RAM. A byte that is written and read at the same edge reads as any value:
// it is not used then, so the RAM need not define it.
`include "dsdpv1_rsu_types.svh"

module telegram_buffer (
  input  logic       clk_i,
  input  logic       we_i,
  input  logic [8:0] waddr_i,
  input  logic [7:0] wdata_i,
  input  logic [8:0] raddr_i,
  output logic [7:0] rdata_o
);
  logic [7:0] memory_q [0:511];

  always_ff @(posedge clk_i) begin
    if (we_i) memory_q[waddr_i] <= wdata_i;
    rdata_o <= we_i && waddr_i == raddr_i ? 8'hxx : memory_q[raddr_i];
  end
endmodule
