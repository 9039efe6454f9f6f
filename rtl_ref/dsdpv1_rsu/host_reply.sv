// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bytes of a reply, one after the other (5.4, 6.3 to 6.5; SP4 to SP6, SP10, UA8, UA10, UA12, UA13). SPI loads one when a slot of eight SCK
// has begun, UART when a character begins.
`include "dsdpv1_rsu_types.svh"

module host_reply (
  `FAULT_PORT
  input  logic [4:0]  gap_i,        // SP6, bytes
  input  logic        cfg_length_i, // UA12
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        spi_i,
  input  logic [1:0]  adr_i,
  // judgement of this edge
  /* verilator lint_off UNUSEDSIGNAL */  // commits and B014 are others'
  input  judgement_t  judgement_i,
  input  telegram_t   telegram_i,
  /* verilator lint_on UNUSEDSIGNAL */
  input  logic        exchanges_i,  // DATA_EXCH
  // what asks for a byte
  input  logic        slot_i,       // SPI: a byte is handed over at this edge
  input  logic        ends_i,       // SPI: the frame ends
  input  logic        next_i,       // UART: a character begins
  output logic        gives_o,      // a byte is given, at this edge
  output logic [7:0]  byte_o,
  output logic        more_o,       // there is one to give
  // where the data are: in the DPRAM, with UART in the buffer
  output logic [10:0] raddr_o,
  input  logic [7:0]  rdata_i,      // SPI
  input  logic [7:0]  bdata_i,      // UART
  // the reply of an exchange
  input  logic [7:0]  function_i,
  input  logic [10:0] area_i,
  input  logic [7:0]  count_i,      // data bytes, of a read too
  // CRC
  output logic        crc_give_o,
  output logic        crc_first_o,
  input  logic [15:0] crc_i
);
  typedef enum logic [3:0] {
    OFF = 4'd0,
    FIRST = 4'd1,
    SECOND = 4'd2,
    ADDRESS_HIGH = 4'd3,
    ADDRESS_LOW = 4'd4,
    COUNT = 4'd5,
    LENGTH = 4'd6,  // SPI's read and write: the outputs' length byte
    DATA = 4'd7,
    CRC_HIGH = 4'd8,
    CRC_LOW = 4'd9
  } state_t;

  // ---- the telegram that is replied to, from its judgement on
  logic [1:0] ask_q, ask;
  logic refused_q, refused, exchanges_q, uart_exchange;
  logic [3:0] code_q, code;
  assign ask = judgement_i.replies ? telegram_i.ask : ask_q;
  assign refused = judgement_i.replies ? judgement_i.refused : refused_q;
  assign code = judgement_i.replies ? judgement_i.code : code_q;
  assign uart_exchange = !spi_i && ask == ASK_EXCHANGE;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {ask_q, refused_q, code_q, exchanges_q} <= 8'd0;
    else begin
      {ask_q, refused_q, code_q} <= {ask, refused, code};
      if (judgement_i.replies) exchanges_q <= exchanges_i;
    end
  end

  // ---- turns: SPI's first two follow the judgement at once (the second a cycle later, many before it is sent), the others a byte's hand-over
  logic [3:0] state_q, state, state_d;
  logic [4:0] gap_q, gap;
  logic second_q, slot_q, turn;
  assign state = judgement_i.replies ? FIRST : state_q;
  assign gap = judgement_i.replies ? (spi_i ? gap_i : 5'd0) : gap_q;
  assign turn = spi_i ? judgement_i.replies || second_q || slot_q : next_i;
  assign gives_o = turn && gap == 5'd0 && !ends_i;  // in OFF FF, which only SPI asks for
  assign more_o = state_q != OFF;

  logic [7:0] left_q;
  logic [10:0] address_q;
  logic last, no_length;
  logic [7:0] length;
  assign length = rdata_i > 8'd244 && !`FAULT(147) ? 8'd244 : rdata_i;
  assign no_length = rdata_i == 8'd0;
  assign last = left_q == 8'd1;
  always_comb begin
    state_d = state;
    if (gives_o) begin
      case (state)
        FIRST: state_d = SECOND;
        SECOND: begin
          if (uart_exchange) state_d = refused ? COUNT : ADDRESS_HIGH;
          else if (refused || ask == ASK_WRITE) state_d = CRC_HIGH;
          else state_d = ask == ASK_READ ? DATA : LENGTH;
        end
        ADDRESS_HIGH: state_d = ADDRESS_LOW;
        ADDRESS_LOW: state_d = COUNT;
        COUNT: state_d = refused ? CRC_HIGH : DATA;
        LENGTH: state_d = no_length ? CRC_HIGH : DATA;
        DATA: if (last) state_d = CRC_HIGH;
        CRC_HIGH: state_d = CRC_LOW;
        default: state_d = OFF;
      endcase
`ifdef SINGLE_FAULTS
      if (`FAULT(214) && state == LENGTH) state_d = DATA;
`endif
    end
    if (ends_i) state_d = OFF;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= OFF;
      gap_q <= 5'd0;
      {second_q, slot_q} <= 2'b00;
      left_q <= 8'd0;
      address_q <= 11'd0;
    end else begin
      state_q <= state_d;
      if (turn && gap != 5'd0) gap_q <= gap - 5'd1;
      else if (judgement_i.replies) gap_q <= gap;
      second_q <= judgement_i.replies;
      slot_q <= slot_i;
      if (judgement_i.replies) address_q <= !spi_i ? 11'd0 : ask == ASK_READ ? telegram_i.address : DSDPV1_REG_OUTPUT;
      else if (gives_o && (state == DATA || state == LENGTH)) address_q <= address_q + 11'd1;
      if (judgement_i.replies && spi_i) left_q <= telegram_i.length;
      else if (gives_o) begin
        if (state == SECOND && !spi_i) left_q <= count_i;  // at the first byte the last one read may still be on its way
        if (state == LENGTH) left_q <= length;
        if (state == DATA) left_q <= left_q - 8'd1;
      end
    end
  end
  assign raddr_o = address_q;

  // ---- the bytes
  logic [1:0] kind;
  logic [7:0] crc_high, crc_low, area_high, area_low, count;
  assign kind = refused ? 2'd3 : ask;
  assign {crc_high, crc_low} = crc_i;
  assign {area_high, area_low} = {5'd0, area_i};
  assign count = cfg_length_i && area_i == DSDPV1_REG_CFG ? count_i - 8'd2 : count_i;
  always_comb begin
    case (state)
      FIRST: byte_o = uart_exchange ? {6'd0, adr_i} : {1'b1, kind, 3'd0, adr_i};
      SECOND: byte_o = !uart_exchange ? {4'd0, code} : refused ? {7'h40, exchanges_q} : function_i;
      ADDRESS_HIGH: byte_o = area_high;
      ADDRESS_LOW: byte_o = area_low;
      COUNT: byte_o = refused ? {4'd0, code} : count;
      LENGTH: byte_o = length;
      DATA: byte_o = spi_i ? rdata_i : bdata_i;
      CRC_HIGH: byte_o = crc_high;
      CRC_LOW: byte_o = crc_low;
      default: byte_o = 8'hFF;
    endcase
  end
  assign crc_give_o = gives_o && state != OFF && state != CRC_HIGH && state != CRC_LOW;
  assign crc_first_o = state == FIRST;
endmodule
