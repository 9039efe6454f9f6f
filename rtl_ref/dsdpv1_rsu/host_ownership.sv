// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// B014.1 and U_Timer (4.1, 5.5; SP12, SP13, SP17): the host owns the DPRAM. SPI only.
`include "dsdpv1_rsu_types.svh"

module host_ownership (
  `FAULT_PORT
  input  logic [22:0] u_timer_i,    // cycles, 0: there is none
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        crc_right_i,  // a telegram with a right CRC is judged at this edge
  input  logic        set_i,        // ... and sets B014.1
  input  logic        value_i,
  input  logic        enable_i,     // B015.0
  output logic        owns_o,       // B014.1
  output logic        shown_o,      // ... as a read of this edge sees it
  output logic        holds_o       // ... as it is after this edge's judgement
);
  logic host_q, host_d, timer_on_q, timer_ends;
  logic [22:0] timer_q;
  assign timer_ends = timer_on_q && timer_q == 23'd0;
  assign owns_o = host_q;
  assign shown_o = host_q && !timer_ends;
  assign host_d = set_i ? value_i : shown_o;
  assign holds_o = host_d;

  logic opens, restarts;
  assign opens = u_timer_i != 23'd0;
  assign restarts = crc_right_i && !(`FAULT(141) && host_q);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      host_q <= 1'b0;
      timer_on_q <= 1'b0;
      timer_q <= 23'd0;
    end else begin
      host_q <= host_d;
      if (restarts) timer_on_q <= opens && host_d && enable_i;
      else if (timer_ends) timer_on_q <= 1'b0;
      if (restarts && opens) timer_q <= u_timer_i - 23'd1;
      else if (timer_on_q) timer_q <= timer_q - 23'd1;
    end
  end
endmodule
