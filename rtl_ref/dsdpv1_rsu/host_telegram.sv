// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Telegrams of the host, byte by byte (5.3, 6.2): their fields, their CRC, and their errors. Data go into the buffer, from
// its byte 1 on; the length byte of SPI's read and write, which is written with them, is byte 0.
//
// Two bytes and more lie between the length byte and the judgement, at least eight cycles each: what address and length say is in registers by then.
`include "dsdpv1_rsu_types.svh"

module host_telegram (
  `FAULT_PORT
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        spi_i,        // else UART
  input  logic [1:0]  adr_i,
  // at this edge
  input  logic        begins_i,     // the next byte is a first one
  input  logic        ends_i,       // SPI: the frame ends, after a byte of this edge
  input  logic        take_i,       // a byte
  input  logic [7:0]  byte_i,
  input  logic        spoil_i,      // UART: a character that is wrong
  input  logic        silence_i,    // UART: the interval is over
  output logic        waits_o,      // for a first byte
  output logic        last_o,       // the last byte of a telegram for this card
  // the CRC of what was taken before
  output logic        crc_take_o,
  output logic        crc_first_o,
  input  logic [15:0] crc_i,
  output logic        we_o,
  output logic [7:0]  waddr_o,
  // at the edge after the last byte
  output logic        judged_o,
  output logic        alive_o,      // SPI: its frame has not ended before this edge
  output telegram_t   telegram_o
);
  typedef enum logic [3:0] {
    OFF = 4'd0,  // nothing is heard until a frame or, after a silence, a telegram begins
    START = 4'd1,
    FUNCTION = 4'd2,
    ADDRESS_HIGH = 4'd3,
    ADDRESS_LOW = 4'd4,
    LENGTH = 4'd5,
    DATA = 4'd6,
    CRC_HIGH = 4'd7,
    CRC_LOW = 4'd8
  } field_t;

  logic [3:0] field_q, field_d, after_start;
  logic [1:0] ask_q, ask, to;
  logic [4:0] high_q;
  logic [10:0] address_q;
  logic [7:0] length_q, index_q;
  logic mine_q, function_q, crc_wrong_q, judged_q, alive_q, covers_q, claims_q;
  assign ask = byte_i[6:5];
  assign to = byte_i[1:0];

  // ---- fields
  logic no_telegram, for_this, last_data;
  assign no_telegram = byte_i[7] || ask == 2'd3 || (byte_i[4:2] != 3'd0 && !`FAULT(137));
  assign for_this = to == adr_i && (adr_i[0] != adr_i[1] || `FAULT(135));
  assign last_data = index_q == length_q;
  assign after_start = ask != ASK_EXCHANGE ? ADDRESS_HIGH : spi_i ? LENGTH : FUNCTION;
  always_comb begin
    field_d = field_q;
    if (take_i) begin
      case (field_q)
        OFF: ;
        START: field_d = no_telegram || (spi_i && !for_this) ? OFF : after_start;
        LENGTH: field_d = byte_i == 8'd0 || ask_q == ASK_READ ? CRC_HIGH : DATA;
        DATA: if (last_data) field_d = CRC_HIGH;
        CRC_LOW: field_d = spi_i ? OFF : START;
        default: field_d = field_q + 4'd1;
      endcase
    end
    if (spoil_i) field_d = `FAULT(138) ? START : OFF;
    if (begins_i || silence_i) field_d = START;
    if (ends_i) field_d = OFF;
  end
  assign waits_o = field_q == START;
  assign last_o = take_i && field_q == CRC_LOW && mine_q;
  assign crc_take_o = take_i && field_q != OFF && field_q != CRC_HIGH && field_q != CRC_LOW;
  assign crc_first_o = field_q == START;
  assign we_o = take_i && (field_q == DATA || field_q == LENGTH);
  assign waddr_o = field_q == DATA ? index_q : 8'd0;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      field_q <= OFF;
      {ask_q, high_q, address_q, length_q, index_q} <= 34'd0;
      {mine_q, function_q, crc_wrong_q, judged_q, alive_q} <= 5'd0;
    end else begin
      field_q <= field_d;
      judged_q <= last_o;
      alive_q <= last_o && !ends_i;
      if (take_i) begin
        case (field_q)
          START: begin
            ask_q <= ask;
            mine_q <= for_this;
          end
          FUNCTION: function_q <= byte_i[1];
          ADDRESS_HIGH: {high_q, address_q} <= {byte_i, address_q[7:0]};
          ADDRESS_LOW: address_q <= {address_q[10:8], byte_i};
          LENGTH: begin
            length_q <= byte_i;
            index_q <= 8'd1;
          end
          DATA: index_q <= index_q + 8'd1;
          CRC_HIGH: crc_wrong_q <= byte_i != crc_i[15:8];
          CRC_LOW: crc_wrong_q <= crc_wrong_q || (byte_i != crc_i[7:0] && !`FAULT(133));
          default: ;
        endcase
      end
    end
  end

  // ---- B014 among the cells of a write: data i goes to address + i and is byte i + 1 here
  logic [10:0] cell_after;
  assign cell_after = address_q + {3'd0, index_q};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      covers_q <= 1'b0;
      claims_q <= 1'b0;
    end else if (take_i && field_q == LENGTH) begin
      covers_q <= 1'b0;
    end else if (take_i &&
`ifdef SINGLE_FAULTS
      !(`FAULT(213) && index_q != 8'd1) &&
`endif
      field_q == DATA && cell_after == RSU_REG_OWNERSHIP + 11'd1 && ask_q == ASK_WRITE) begin
      covers_q <= spi_i;
      claims_q <= byte_i[1];
    end
  end

  // ---- errors (SP10, UA5, UA9, UA13)
  logic [7:0] most_data, most_bytes, area_size;
  logic [11:0] end_address;
  logic [1:0] area;
  logic known, beyond, exchange;
  assign exchange = ask_q == ASK_EXCHANGE;
  assign end_address = {1'b0, address_q} + {4'd0, length_q};
  assign beyond =
`ifdef SINGLE_FAULTS
      (`FAULT(212) && end_address == DSDPV1_REG_DPRAM_SIZE) ||
`endif
      end_address > DSDPV1_REG_DPRAM_SIZE && !`FAULT(136);
  always_comb begin
    known = 1'b1;
    area = TO_INPUTS;
    area_size = 8'd244;
    case (address_q)
      DSDPV1_REG_INPUT: area_size = 8'd245;
      DSDPV1_REG_DIAG: begin
        area = TO_DIAGNOSIS;
        area_size = 8'd240;
      end
      DSDPV1_REG_C1: area = TO_C1;
      DSDPV1_REG_C2: area = TO_C2;
      default: begin
        known = 1'b0;
        area_size = 8'd250;
      end
    endcase
    most_bytes = !spi_i ? 8'd250 : exchange ? 8'd247 : 8'd245;
    if (spi_i) most_data = exchange ? 8'd244 : 8'd245;
    else most_data = exchange ? (high_q == 5'd0 ? area_size : 8'd250) : ask_q == ASK_READ ? 8'd245 : 8'd250;
  end

  logic [1:0] area_q;
  logic address_wrong_q, data_wrong_q, length_wrong_q;
  always_ff @(posedge clk_i) begin
    area_q <= spi_i ? TO_INPUTS : area;
    address_wrong_q <= (high_q != 5'd0 && !(spi_i && exchange) && !`FAULT(134)) ||
                       (!spi_i && exchange && (!known || (area == TO_DIAGNOSIS && !function_q)));
    data_wrong_q <= length_q > most_data || (length_q == 8'd0 && !(spi_i && exchange)) || (!exchange && beyond);
    length_wrong_q <= ask_q != ASK_READ && length_q > most_bytes;
  end

  assign judged_o = judged_q;
  assign alive_o = alive_q;
  assign telegram_o.ask = ask_q;
  assign telegram_o.address = address_q;
  assign telegram_o.length = length_q;
  assign telegram_o.area = area_q;
  assign telegram_o.crc_wrong = crc_wrong_q;
  assign telegram_o.address_wrong = address_wrong_q;
  assign telegram_o.data_wrong = data_wrong_q;
  assign telegram_o.length_wrong = length_wrong_q;
  assign telegram_o.covers = covers_q;
  assign telegram_o.claims = claims_q;
endmodule
