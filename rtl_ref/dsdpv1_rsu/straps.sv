// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The straps (section 2, R11), taken at R, the first edge without reset.
`include "dsdpv1_rsu_types.svh"

module straps (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic [1:0] mode_i,
  input  logic [1:0] adr_i,
  input  logic [2:0] ubr_i,
  input  logic [2:0] uiv_i,
  output logic       begins_o,  // this edge is R
  output logic       spi_o,     // already at R
  output logic       uart_o,
  output logic       closed_o,  // after R, without a pin in between: the mode is not parallel
  output logic [1:0] adr_o,     // after R
  output logic [2:0] ubr_o,
  output logic [2:0] uiv_o
);
  logic taken_q;
  logic [9:0] straps_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      taken_q <= 1'b0;
      straps_q <= 10'd0;
    end else if (!taken_q) begin
      taken_q <= 1'b1;
      straps_q <= {mode_i, adr_i, ubr_i, uiv_i};
    end
  end
  logic [1:0] mode, mode_taken;
  assign {mode_taken, adr_o, ubr_o, uiv_o} = straps_q;
  assign mode = taken_q ? mode_taken : mode_i;
  assign begins_o = !taken_q;
  assign spi_o = mode == MODE_SPI;
  assign uart_o = mode == MODE_UART;
  assign closed_o = mode_taken == MODE_SPI || mode_taken == MODE_UART;
endmodule
