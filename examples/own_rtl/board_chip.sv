// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// A chip as a user might provide it for co-simulation: the pins have other names and polarities, and a separate pulse generator makes
// INTR0. It contains two faults; docs/tutorials/own_rtl.md shows how they are found.
module board_chip #(
  parameter integer SEARCH_WINDOW_MS = 50,
  parameter integer PULSE = 60,           // wrong: the low time is 64 cycles (P7)
  parameter integer RESET_VALUE = 0       // wrong: 0 leaves the pulse counter without a reset
) (
  input  logic        clk,
  input  logic        rst,                // high: reset
  input  logic        rxd,
  output logic        txd,
  output logic        tx_enable,
  input  logic        user_request,
  input  logic        user_state,
  output logic        chip_request,
  output logic        chip_state,
  input  logic [10:0] addr,
  input  logic [7:0]  data_in,
  output logic [7:0]  data_out,
  output logic        data_drive,
  input  logic        cs,                 // high: selected
  input  logic        rd_n,
  input  logic        wr_n,
  output logic        irq,                // high: interrupt
  output logic        led_no_exchange,
  output logic        led_baud,
  output logic        led_ready
);
  logic intr0, intr0_q;
  logic [6:0] count_q;

  dsdpv1 #(.SEARCH_WINDOW_MS(SEARCH_WINDOW_MS)) u_chip (
    .reset_i(!rst), .clk_i(clk), .pbrxd_i(rxd), .pbtxd_o(txd), .pbrts_o(tx_enable), .r_req_i(user_request),
    .r_sta_i(user_state), .l_req_o(chip_request), .l_sta_o(chip_state), .a_i(addr), .d_i(data_in), .d_o(data_out),
    .d_oe_o(data_drive), .csr_i(!cs), .rd_i(rd_n), .wr_i(wr_n), .intr0_o(intr0), .pbf_o(led_no_exchange), .br_o(led_baud),
    .ready_o(led_ready));

  // irq is high while count_q counts down; without a reset it may be high after power-on for an arbitrary time
  logic clear;
  assign clear = rst && RESET_VALUE != 0;
  always_ff @(posedge clk or posedge clear) begin
    if (clear) begin
      intr0_q <= 1'b1;
      count_q <= 7'd0;
    end else begin
      intr0_q <= intr0;
      if (intr0_q && !intr0) count_q <= PULSE[6:0];
      else if (count_q != 7'd0) count_q <= count_q - 7'd1;
    end
  end
  assign irq = count_q != 7'd0;
endmodule
