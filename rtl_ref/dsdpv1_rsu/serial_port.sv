// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The two serial host ports, SPI and UART, of which the mode selects one or none: telegrams, their judgement, commit and reply.
//
// A reply reads the DPRAM while the chip may be in an access (SP14), so there is a second copy of it, which all writes go to.
`include "dsdpv1_rsu_types.svh"

module serial_port (
  `FAULT_PORT
  input  logic [4:0]   spi_reply_gap_i,
  input  logic [12:0]  spi_write_gap_i,
  input  logic [22:0]  u_timer_i,
  input  logic [127:0] uart_gaps_i,
  input  logic [7:0]   uart_min_tsdr_i,
  input  logic         uart_cfg_length_i,
  input  logic         clk_i,
  input  logic         rst_ni,
  input  logic         begins_i,     // edge R
  input  logic         spi_i,
  input  logic         uart_i,
  input  logic [1:0]   adr_i,
  input  logic [2:0]   ubr_i,
  input  logic [2:0]   uiv_i,
  // pins
  input  logic         xss_i,
  input  logic         sck_i,
  input  logic         mosi_i,
  output logic         miso_o,
  output logic         miso_oe_o,
  input  logic         rxd_i,
  output logic         txd_o,
  // the rest of the chip
  output logic         holds_o,      // no access may begin at this edge
  output logic         host_owns_o,  // B014.1
  input  logic         owns_i,
  input  logic         exchanges_i,  // DATA_EXCH
  input  logic         chip_we_i,    // the chip's writes, for the copy
  input  logic [10:0]  chip_addr_i,
  input  logic [7:0]   chip_wdata_i,
  output logic         we_o,         // the host's
  output logic [10:0]  waddr_o,
  output logic [7:0]   wdata_o
);
  telegram_t telegram;
  judgement_t judgement;

  // ---- bytes from either port
  logic frame_begins, frame_ends, spi_take, odd, gap, commit_waits, load, load_odd;
  logic uart_take, spoil, silence, telegram_waits, last, next, take, commit_busy, gives, more;
  logic [7:0] spi_byte, uart_byte, request_byte, reply_byte;
  spi_port u_spi (
    `FAULT_CONNECT
    .write_gap_i(spi_write_gap_i), .clk_i(clk_i), .rst_ni(rst_ni), .on_i(spi_i), .xss_i(xss_i), .sck_i(sck_i), .mosi_i(mosi_i),
    .miso_o(miso_o), .miso_oe_o(miso_oe_o), .begins_o(frame_begins), .take_o(spi_take), .byte_o(spi_byte), .ends_o(frame_ends),
    .odd_o(odd), .deaf_i(commit_waits), .gap_i(gap), .load_i(load), .load_odd_i(load_odd), .load_byte_i(reply_byte));

  // the host's last values of B015, B019 and B01A (5.5)
  logic enable_q;
  logic [2:0] interval_q;
  logic [7:0] tsdr_q;
  host_uart u_uart (
    `FAULT_CONNECT
    .gaps_i(uart_gaps_i), .min_tsdr_i(uart_min_tsdr_i), .clk_i(clk_i), .rst_ni(rst_ni), .on_i(uart_i), .begins_i(begins_i),
    .ubr_i(ubr_i), .uiv_i(uiv_i), .rxd_i(rxd_i), .txd_o(txd_o), .interval_i(interval_q), .tsdr_i(tsdr_q), .take_o(uart_take),
    .spoil_o(spoil), .silence_o(silence), .byte_o(uart_byte), .waits_i(telegram_waits), .last_i(last),
    .judged_i(judgement.replies && uart_i), .busy_i(commit_busy), .next_o(next), .byte_i(reply_byte), .more_i(more));
  assign take = spi_i ? spi_take : uart_take;
  assign request_byte = spi_i ? spi_byte : uart_byte;
  assign gap = spi_i && last && telegram.ask != ASK_READ;

  // ---- telegram and judgement
  logic crc_take, crc_take_first, crc_give, crc_give_first, buffer_we, judged, alive;
  logic [15:0] crc;
  logic [7:0] buffer_waddr;
  host_telegram u_telegram (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .spi_i(spi_i), .adr_i(adr_i), .begins_i(spi_i ? frame_begins : uart_i && begins_i),
    .ends_i(frame_ends), .take_i(take), .byte_i(request_byte), .spoil_i(spoil), .silence_i(silence), .waits_o(telegram_waits),
    .last_o(last), .crc_take_o(crc_take), .crc_first_o(crc_take_first), .crc_i(crc), .we_o(buffer_we), .waddr_o(buffer_waddr),
    .judged_o(judged), .alive_o(alive), .telegram_o(telegram));

  telegram_crc u_crc (
    .clk_i(clk_i), .rst_ni(rst_ni), .take_i(crc_take), .take_first_i(crc_take_first), .take_byte_i(request_byte),
    .give_i(crc_give), .give_first_i(crc_give_first), .give_byte_i(reply_byte), .crc_o(crc));

  host_judgement u_judgement (
    `FAULT_CONNECT
    .spi_i(spi_i), .judged_i(judged), .replies_i(!spi_i || (alive && !frame_ends)), .telegram_i(telegram), .owns_i(owns_i),
    .busy_i(commit_busy), .judgement_o(judgement));

  // ---- ownership
  logic host_shown, host_holds, commit_holds, frame_holds, frame_holds_q;
  host_ownership u_ownership (
    `FAULT_CONNECT
    .u_timer_i(u_timer_i), .clk_i(clk_i), .rst_ni(rst_ni), .crc_right_i(judgement.crc_right && spi_i), .set_i(judgement.owns),
    .value_i(telegram.claims), .enable_i(enable_q), .owns_o(host_owns_o), .shown_o(host_shown), .holds_o(host_holds));

  // A read and write keeps the chip off until its frame ends (SP16)
  assign frame_holds = (frame_holds_q || (spi_i && judgement.commits && judgement.replies && telegram.ask == ASK_EXCHANGE)) && !frame_ends;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) frame_holds_q <= 1'b0;
    else frame_holds_q <= frame_holds && !`FAULT(151);
  end
  assign holds_o = host_holds || commit_holds || frame_holds;

  // ---- commit
  logic commit_reads, reply_we;
  logic [10:0] commit_raddr, reply_raddr, area;
  logic [7:0] rdata, buffer_raddr, buffer_data, reply_waddr, reply_wdata, function_byte, count;
  host_commit u_commit (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .spi_i(spi_i), .start_i(judgement.commits), .telegram_i(telegram), .owns_i(owns_i),
    .exchanges_i(exchanges_i), .busy_o(commit_busy), .waits_o(commit_waits), .holds_o(commit_holds), .we_o(we_o), .waddr_o(waddr_o),
    .wdata_o(wdata_o), .reads_o(commit_reads), .raddr_o(commit_raddr), .rdata_i(rdata), .baddr_o(buffer_raddr), .bdata_i(buffer_data),
    .reply_we_o(reply_we), .reply_addr_o(reply_waddr), .reply_data_o(reply_wdata), .function_o(function_byte), .area_o(area),
    .count_o(count));

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      enable_q <= 1'b0;
      interval_q <= 3'd0;
      tsdr_q <= 8'd0;
    end else if (we_o) begin
      if (waddr_o == RSU_REG_U_TIMER) enable_q <= wdata_o[0];
      if (waddr_o == RSU_REG_UART_INTERVAL) interval_q <= wdata_o[7:3] == 5'd0 ? wdata_o[2:0] : 3'd0;
`ifdef SINGLE_FAULTS
      if (`FAULT(218) && waddr_o == RSU_REG_UART_INTERVAL) interval_q <= wdata_o[2:0];
`endif
      if (waddr_o == RSU_REG_UART_TSDR) tsdr_q <= wdata_o;
    end
  end

  // ---- reply
  logic [7:0] spi_data;
  host_reply u_reply (
    `FAULT_CONNECT
    .gap_i(spi_reply_gap_i), .cfg_length_i(uart_cfg_length_i), .clk_i(clk_i), .rst_ni(rst_ni), .spi_i(spi_i), .adr_i(adr_i),
    .judgement_i(judgement), .telegram_i(telegram), .exchanges_i(exchanges_i), .slot_i(spi_take), .ends_i(frame_ends), .next_i(next),
    .gives_o(gives), .byte_o(reply_byte), .more_o(more), .raddr_o(reply_raddr), .rdata_i(spi_data), .bdata_i(buffer_data),
    .function_i(function_byte), .area_i(area), .count_i(count), .crc_give_o(crc_give), .crc_first_o(crc_give_first), .crc_i(crc));
  assign load = gives;
  assign load_odd = odd ^ !judgement.replies;

  // B014 is a register, not a cell, and before the start-up access has ended all others are read as 00 (5.4)
  logic owned_q, started_q, started, register_q, blank_q, host_q, chip_q;
  assign started = started_q || (owned_q && !owns_i);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {owned_q, started_q, register_q, blank_q, host_q, chip_q} <= 6'd0;
    else begin
      owned_q <= owned_q || owns_i;
      started_q <= started;
      register_q <= reply_raddr == RSU_REG_OWNERSHIP;
      blank_q <= !started;
      host_q <= host_shown;
      chip_q <= owns_i && !`FAULT(146);
    end
  end
  assign spi_data = register_q ? {6'd0, host_q, chip_q} : blank_q ? 8'h00 : rdata;

  // ---- memories: the DPRAM's copy; the buffer, a request's data in its lower half and the reply's, with UART, in the upper one
  logic copy_we;
  logic [10:0] copy_waddr;
  logic [7:0] copy_wdata;
  assign copy_we = chip_we_i || we_o;
  assign copy_waddr = chip_we_i ? chip_addr_i : waddr_o;
  assign copy_wdata = chip_we_i ? chip_wdata_i : wdata_o;
  buffer_ram #(.ADDRESS_BITS(11), .BYTES(2048)) u_copy (
    .clk_i(clk_i), .we_i(copy_we), .waddr_i(copy_waddr), .wdata_i(copy_wdata), .raddr_i(commit_reads ? commit_raddr : reply_raddr),
    .rdata_o(rdata));
  telegram_buffer u_buffer (
    .clk_i(clk_i), .we_i(buffer_we || (reply_we && uart_i)), .waddr_i(buffer_we ? {1'b0, buffer_waddr} : {1'b1, reply_waddr}),
    .wdata_i(buffer_we ? request_byte : reply_wdata),
    .raddr_i(uart_i && !commit_busy && !judged ? {1'b1, reply_raddr[7:0]} : {1'b0, buffer_raddr}), .rdata_o(buffer_data));
endmodule
