// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The part of the SPI port that SCK clocks (5.1; SP1 to SP3): bits from MOSI to bytes, bits of the reply to MISO.
//
// byte_o stands from the eighth rise to the next but seven, flip_o says that there is a new one. miso_o changes at SCK's fall; what SP2
// allows it to be later is the pin's.
`include "dsdpv1_rsu_types.svh"

module spi_shift (
  `FAULT_PORT
  input  logic       rst_ni,
  input  logic       listening_i,
  input  logic       xss_i,
  input  logic       sck_i,
  input  logic       mosi_i,
  output logic       miso_o,
  output logic       miso_oe_o,
  input  logic [7:0] tx0_i,       // of bytes 0, 2, 4, ... of a frame
  input  logic [7:0] tx1_i,
  output logic [7:0] byte_o,
  output logic       flip_o
);
  logic run;
  assign run = listening_i && !xss_i;

  // Initial values, because SCK may be silent for as long as these are held in reset: a simulation sees no edge of it
  logic [3:0] bits_q = 4'd0;  // rises in this frame, modulo 16
  logic any_q = 1'b0;
  logic flip_q = 1'b0;
  logic miso_q = 1'b1;

  logic [2:0] place;
  assign place = bits_q[2:0];
  always_ff @(posedge sck_i or negedge run) begin
    if (!run) begin
      bits_q <= 4'd0;
      any_q <= 1'b0;
    end else begin
      bits_q <= bits_q + 4'd1;
      any_q <= 1'b1;
    end
  end

  logic [6:0] shift_q;
  logic [7:0] byte_q;
  logic last;
  assign last = place == 3'd7;  // never while the count is held at 0
  always_ff @(posedge sck_i) begin
    shift_q <= {shift_q[5:0], mosi_i};
    if (last) byte_q <= {shift_q, mosi_i};
  end
  always_ff @(posedge sck_i or negedge rst_ni) begin
    if (!rst_ni) flip_q <= 1'b0;
    else if (last) flip_q <= !flip_q;
  end
  assign byte_o = byte_q;
  assign flip_o = flip_q;

  logic [7:0] slot;
  assign slot = bits_q[3] ? tx1_i : tx0_i;
  always_ff @(negedge sck_i or negedge run) begin
    if (!run) miso_q <= 1'b1;
    else if (any_q) miso_q <= slot[`FAULT(129) ? place : ~place];
  end
  assign miso_o = miso_q;
  assign miso_oe_o = run;
endmodule
