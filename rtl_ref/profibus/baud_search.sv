// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Search for the baud rate (8.1; S1, S9): from 12 Mbit/s downwards, wrapping, until a telegram without error is decided.
`include "profibus_types.svh"

module baud_search (
  `FAULT_PORT
  input  logic [31:0] window_ms_i,
  input  logic [31:0] window_bits_i,
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        start_i,      // initialisation, or BAUD_CONTROL ends
  input  logic        telegram_i,   // a synced SD1, SD2 or SD3 is decided
  output logic        restart_o,    // a rate is selected at this edge
  output logic [3:0]  rate_o,
  output logic        searching_o,  // also before the first initialisation
  output logic        found_o,      // at this edge
  output logic        br_o
);
  // The counter is loaded one edge after the start and the end is seen one edge ahead: cycles of a window less two.
  function automatic logic [31:0] window(input logic [31:0] ms, input logic [31:0] bits, input logic [31:0] len);
    window = (bits * len > ms * 32'd48000 ? bits * len : ms * 32'd48000) - 32'd2;
  endfunction

  logic active_q, searching_q, br_q;
  logic [3:0] rate_q, rate_d;
  logic [31:0] window_q, window_d;
  logic last_q, loads_q, ends;

  assign ends = active_q && searching_q && last_q;
  assign restart_o = start_i || ends;
  assign found_o = active_q && searching_q && telegram_i && !restart_o;

  // Index 0 lowest
  logic [319:0] windows;
  logic [31:0] window_of_rate;
  assign windows = {
    window(window_ms_i, window_bits_i, 32'd5000), window(window_ms_i, window_bits_i, 32'd2500),
    window(window_ms_i, window_bits_i, 32'd1056), window(window_ms_i, window_bits_i, 32'd512),
    window(window_ms_i, window_bits_i, 32'd256), window(window_ms_i, window_bits_i, 32'd96),
    window(window_ms_i, window_bits_i, 32'd32), window(window_ms_i, window_bits_i, 32'd16),
    window(window_ms_i, window_bits_i, 32'd8), window(window_ms_i, window_bits_i, 32'd4)};
  assign window_of_rate = windows[{rate_q, 5'd0}+:32];

  always_comb begin
    rate_d = rate_q;
    if (start_i) rate_d = 4'd0;
    else if (ends) rate_d = rate_q >= RATE_LAST - (`FAULT(61) ? 4'd1 : 4'd0) ? 4'd0 : rate_q + 4'd1;
    window_d = loads_q ? window_of_rate : window_q - 32'd1;
`ifdef SINGLE_FAULTS
    if (`FAULT(168) && loads_q) window_d = window_of_rate + 32'd1;
    if (`FAULT(199) && loads_q) window_d = window_ms_i * 32'd48000 - 32'd2;
`endif
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      active_q <= 1'b0;
      searching_q <= 1'b1;
      br_q <= 1'b0;
      rate_q <= 4'd0;
      window_q <= 32'd0;
      {last_q, loads_q} <= 2'b00;
    end else begin
      rate_q <= rate_d;
      window_q <= window_d;
      loads_q <= restart_o;
      last_q <= !restart_o && !loads_q && window_q == 32'd1;
      if (start_i) begin
        active_q <= 1'b1;
        searching_q <= 1'b1;
        br_q <= 1'b0;
      end else if (found_o) begin
        searching_q <= 1'b0;
        br_q <= 1'b1;
      end
    end
  end

  assign rate_o = rate_q;
  assign searching_o = searching_q;
  assign br_o = br_q;
endmodule
