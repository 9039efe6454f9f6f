// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// When the chip accesses the DPRAM (H1), and since when it is ready (D1).
`include "dpram_types.svh"

module dpram_pace (
  `FAULT_PORT
  input  logic [12:0] access_interval_i,  // H1
  input  logic [20:0] ready_cycles_i,     // D1
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        begins_i,           // an access, at this edge
  output logic        due_o,              // the next one
  output logic        ready_o
);
  logic [12:0] since_q;
  assign due_o = since_q >= access_interval_i + (`FAULT(48) ? 13'd1 : 13'd0);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) since_q <= 13'd0;
    else if (begins_i) since_q <= 13'd1;
    else if (!(&since_q)) since_q <= since_q + 13'd1;
  end

  logic [20:0] up_q;
  assign ready_o = up_q == ready_cycles_i;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) up_q <= 21'd0;
    else if (up_q != ready_cycles_i) up_q <= up_q + 21'd1;
  end
endmodule
