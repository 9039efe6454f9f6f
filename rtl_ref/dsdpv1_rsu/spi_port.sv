// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The SPI port towards CLK (5.2, 5.4): frames, their bytes, and the two registers of the reply that SCK shifts out.
`include "dsdpv1_rsu_types.svh"

module spi_port (
  `FAULT_PORT
  input  logic [12:0] write_gap_i,  // SP9
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        on_i,         // the mode is SPI
  input  logic        xss_i,
  input  logic        sck_i,
  input  logic        mosi_i,
  output logic        miso_o,
  output logic        miso_oe_o,
  // at this edge
  output logic        begins_o,     // X of a frame that is heard
  output logic        take_o,       // H
  output logic [7:0]  byte_o,
  output logic        ends_o,       // Y
  output logic        odd_o,        // the number of bytes handed over before is odd
  input  logic        deaf_i,       // a write waits: a frame that begins now is ignored
  input  logic        gap_i,        // the last byte of a telegram after which a gap has to be kept
  // load of the reply
  input  logic        load_i,
  input  logic        load_odd_i,
  input  logic [7:0]  load_byte_i
);
  // SCK's half
  logic listening_q, flip, flip_first_q, flip_q, flip_before_q;
  logic [7:0] tx0_q, tx1_q;
  spi_shift u_shift (
    `FAULT_CONNECT
    .rst_ni(rst_ni), .listening_i(listening_q), .xss_i(xss_i), .sck_i(sck_i), .mosi_i(mosi_i), .miso_o(miso_o), .miso_oe_o(miso_oe_o),
    .tx0_i(tx0_q), .tx1_i(tx1_q), .byte_o(byte_o), .flip_o(flip));

  // Synchronisers: that of XSS runs during reset, that of flip begins with it
  logic xss, xss_before_q;
  synchroniser #(.POWER_ON(1'b1)) u_xss (.clk_i(clk_i), .d_i(xss_i), .q_o(xss));
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {flip_first_q, flip_q, flip_before_q} <= 3'd0;
    else {flip_first_q, flip_q, flip_before_q} <= {flip, `FAULT(130) ? flip : flip_first_q, flip_q};
  end

  // Events
  logic frame_begins, heard;
  logic [12:0] gap_q;  // cycles since the last write, up to the gap
  assign frame_begins = listening_q && !xss && xss_before_q;
  assign ends_o = listening_q && xss && !xss_before_q;
  assign take_o = listening_q && flip_q != flip_before_q;
  assign heard =
`ifdef SINGLE_FAULTS
      !(`FAULT(210) && gap_q == write_gap_i) &&
`endif
      (gap_q >= write_gap_i || `FAULT(131)) && !deaf_i;
  assign begins_o = frame_begins && heard;

  logic odd_q;
  assign odd_o = odd_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      listening_q <= 1'b0;
      xss_before_q <= 1'b1;
      odd_q <= 1'b0;
      gap_q <= 13'h1FFF;
    end else begin
      if (on_i && xss) listening_q <= 1'b1;
      xss_before_q <= xss;
      if (frame_begins) odd_q <= 1'b0;
      else if (take_o) odd_q <= !odd_q;
`ifdef SINGLE_FAULTS
      if (`FAULT(211) && frame_begins) odd_q <= odd_q;
`endif
      if (gap_i) gap_q <= 13'd1;
      else if (gap_q != 13'h1FFF) gap_q <= gap_q + 13'd1;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      tx0_q <= 8'hFF;
      tx1_q <= 8'hFF;
    end else if (ends_o && !`FAULT(132)) begin
      tx0_q <= 8'hFF;
      tx1_q <= 8'hFF;
    end else if (load_i) begin
      if (load_odd_i) tx1_q <= load_byte_i;
      else tx0_q <= load_byte_i;
    end
  end
endmodule
