// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Commits (4.2, 6.4; SP9, SP16, UA6, UA9 to UA12): a telegram's changes to the DPRAM, one byte a cycle, while no access of the chip runs.
//
// The state says what the next edge does. A byte read at one edge is in rdata_i (bdata_i) at the next. With UART the bytes of a reply go into
// the buffer's other half as they arrive. An exchange reads the flags of host and chip first, writes its bytes, raises its flag, then reads the
// area that host_choice names, and takes the flag of that area away.
`include "dsdpv1_rsu_types.svh"

module host_commit (
  `FAULT_PORT
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        spi_i,
  input  logic        start_i,      // a commit is judged at this edge
  /* verilator lint_off UNUSEDSIGNAL */  // errors and B014 are host_judgement's
  input  telegram_t   telegram_i,
  /* verilator lint_on UNUSEDSIGNAL */
  input  logic        owns_i,
  input  logic        exchanges_i,  // DATA_EXCH
  output logic        busy_o,       // was not done before this edge
  output logic        waits_o,      // an access of the chip is waited for
  output logic        holds_o,      // is not done at this edge
  // DPRAM
  output logic        we_o,
  output logic [10:0] waddr_o,
  output logic [7:0]  wdata_o,
  output logic        reads_o,
  output logic [10:0] raddr_o,
  input  logic [7:0]  rdata_i,
  // buffer
  output logic [7:0]  baddr_o,
  input  logic [7:0]  bdata_i,
  output logic        reply_we_o,
  output logic [7:0]  reply_addr_o,
  output logic [7:0]  reply_data_o,
  // the reply of an exchange
  output logic [7:0]  function_o,
  output logic [10:0] area_o,
  output logic [7:0]  count_o       // bytes read
);
  typedef enum logic [3:0] {
    IDLE = 4'd0,
    PENDING = 4'd1,      // for the end of an access of the chip
    READ_USER = 4'd2,    // B010 or B011
    READ_CHIP_1 = 4'd3,  // B00E
    READ_CHIP_2 = 4'd4,  // B00F
    WRITE = 4'd5,        // a byte of the telegram
    FLAG = 4'd6,         // B010 or B011 with the flag
    CHOICE = 4'd7,       // of the area, and its first byte
    HEADER = 4'd8,
    LOOK = 4'd9,         // the length arrives
    READ = 4'd10,
    CLEAR = 4'd11        // B00E or B00F without the area's flag
  } state_t;
  state_t state_q, state_d, first;

  // ---- what the telegram asks for
  logic exchange, spi_exchange, news;
  logic [1:0] ask;
  assign ask = telegram_i.ask;
  assign exchange = ask == ASK_EXCHANGE;
  assign spi_exchange = spi_i && exchange;
  assign news = telegram_i.area == TO_INPUTS;
  always_comb begin
    if (exchange) first = READ_USER;
    else if (ask == ASK_WRITE) first = WRITE;
    else first = READ;
  end

  // ---- flags, as they were read
  logic [7:0] user_q, chip_1_q, chip_2_q;
  logic chip_1_arrives_q, chip_2_arrives_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {chip_1_arrives_q, chip_2_arrives_q} <= 2'b00;
      {user_q, chip_1_q, chip_2_q} <= 24'd0;
    end else begin
      chip_1_arrives_q <= state_q == READ_CHIP_1;
      chip_2_arrives_q <= state_q == READ_CHIP_2;
      if (state_q == READ_CHIP_1) user_q <= rdata_i;
      if (chip_1_arrives_q) chip_1_q <= rdata_i;
      if (chip_2_arrives_q) chip_2_q <= rdata_i;
    end
  end

  // ---- the area that is replied
  area_t area, area_q;
  logic acyclic;
  logic [10:0] base;
  logic [1:0] header_more;  // its bytes after the first
  host_choice u_choice (
    `FAULT_CONNECT
    .news_i(news), .prm_i(chip_1_q[1]), .cfg_i(chip_1_q[2]), .c1_i(chip_2_q[0]), .c2_i(chip_2_q[1]), .area_o(area), .base_o(base),
    .header_o(header_more));
  assign acyclic = area_q == AREA_C1 || area_q == AREA_C2;

  // The choice fixes two bits of the reply: DATA_EXCH, and whether the area's flag is taken away; SPI always takes it
  logic clears_q, exchanges_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      area_q <= AREA_OUTPUTS;
      {clears_q, exchanges_q} <= 2'b00;
    end else if (start_i) begin
      clears_q <= spi_i;
    end else if (state_q == CHOICE) begin
      area_q <= area;
      exchanges_q <= exchanges_i;
      clears_q <= news && (area != AREA_OUTPUTS || chip_1_q[0]);
    end
  end

  // ---- length of the area: the header's last byte, as it arrives
  logic has_data_q, empty;
  logic [7:0] most, limited;
  always_comb begin
    case (area_q)
      AREA_PARAMETERS: most = 8'd237;
      AREA_CONFIGURATION: most = 8'd200;
      AREA_C1, AREA_C2: most = 8'd240;
      default: most = `FAULT(145) ? 8'd255 : 8'd244;
    endcase
  end
  assign limited = rdata_i > most ? most : rdata_i;
  assign empty = (acyclic && !has_data_q) || rdata_i == 8'd0;

  // ---- next state
  logic [7:0] left_q;
  logic exchange_q, last, clears;
  assign last = left_q == 8'd1;
  assign clears = exchange_q && clears_q;
  always_comb begin
    state_d = state_q;
    case (state_q)
      IDLE: if (start_i) begin
        if (owns_i) state_d = PENDING;
        else state_d = first;
      end
      PENDING: if (!owns_i) state_d = first;
      READ_USER: state_d = READ_CHIP_1;
      READ_CHIP_1: if (spi_i) state_d = WRITE; else state_d = READ_CHIP_2;
      READ_CHIP_2: state_d = WRITE;
      WRITE: if (last) begin
        if (exchange_q) state_d = FLAG;
        else state_d = IDLE;
      end
      FLAG: if (spi_i) state_d = CLEAR; else state_d = CHOICE;
      CHOICE: if (header_more == 2'd0) state_d = LOOK; else state_d = HEADER;
      HEADER: if (last) state_d = LOOK;
      LOOK: begin
        if (!empty) state_d = READ;
        else if (clears_q) state_d = CLEAR;
        else state_d = IDLE;
      end
      READ: if (last) begin
        if (clears) state_d = CLEAR;
        else state_d = IDLE;
      end
      default: state_d = IDLE;
    endcase
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) state_q <= IDLE;
    else state_q <= state_d;
  end
  assign busy_o = state_q != IDLE;
  assign waits_o = state_q == PENDING || (start_i && owns_i);
  assign holds_o = state_d != IDLE && !`FAULT(142);

  // ---- where it is: address of the next byte in the DPRAM, bytes that are left, the buffer's next byte, written or read
  logic [10:0] address_q;
  logic [7:0] index_q, first_index;
  logic reads_area, moves, arrives_q;
  assign first_index = spi_exchange ? 8'd0 : 8'd1;
  assign reads_area = state_q == CHOICE || state_q == HEADER || state_q == READ;
  assign moves = state_q == WRITE || reads_area;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {address_q, left_q} <= 19'd0;
      exchange_q <= 1'b0;
    end else if (start_i) begin
      exchange_q <= exchange;
      address_q <= spi_exchange ? DSDPV1_REG_INPUT : telegram_i.address;
      left_q <= telegram_i.length + {7'd0, spi_exchange};
    end else if (state_q == CHOICE) begin
      address_q <= base + 11'd1;
      left_q <= {6'd0, header_more};
    end else if (state_q == LOOK) begin
      left_q <= limited;
    end else if (moves) begin
      address_q <= address_q + 11'd1;
      left_q <= left_q - 8'd1;
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) index_q <= 8'd0;
    else if (start_i) index_q <= ask == ASK_READ ? 8'd0 : first_index;
    else if (state_q == CHOICE) index_q <= 8'd0;
    else if (state_q == LOOK || state_q == WRITE || arrives_q) index_q <= index_q + 8'd1;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {arrives_q, has_data_q} <= 2'b00;
    end else begin
      arrives_q <= reads_area;
      if (arrives_q && index_q == 8'd0) has_data_q <= rdata_i == MSAC_WRITE || rdata_i == MSAC_TRANSPORT;
    end
  end

  // ---- flags, as they are written: the host's with the one of this telegram, the chip's without the one of the area
  logic [10:0] flag_address;
  logic [7:0] with_flag, chip_1_without, chip_2_without;
  assign flag_address = telegram_i.area[1] && !spi_i ? DSDPV1_REG_USER_COMMAND_2 : DSDPV1_REG_USER_COMMAND_1;
  assign with_flag =
`ifdef SINGLE_FAULTS
      (`FAULT(217) ? 8'h00 : 8'hFF) &
`endif
      user_q | (telegram_i.area[0] && !spi_i ? 8'h02 : 8'h01);
  always_comb begin
    case (area_q)
      AREA_PARAMETERS: chip_1_without = chip_1_q & ~DSDPV1_REG_CHIP_COMMAND_1_PRM;
      AREA_CONFIGURATION: chip_1_without = chip_1_q & ~DSDPV1_REG_CHIP_COMMAND_1_CFG;
      default: chip_1_without = chip_1_q & ~DSDPV1_REG_CHIP_COMMAND_1_OUTPUT;
    endcase
  end
  assign chip_2_without = chip_2_q & (area_q == AREA_C1 ? ~DSDPV1_REG_CHIP_COMMAND_2_C1 : ~DSDPV1_REG_CHIP_COMMAND_2_C2);

  // ---- DPRAM
  always_comb begin
    we_o = 1'b0;
    waddr_o = address_q;
    wdata_o = bdata_i;
    case (state_q)
      WRITE: we_o = !(spi_i && address_q == RSU_REG_OWNERSHIP);
      FLAG: begin
        we_o = 1'b1;
        waddr_o = flag_address;
        wdata_o = with_flag;
      end
      CLEAR: begin
        we_o = !(`FAULT(143) && spi_i);
        waddr_o = acyclic ? DSDPV1_REG_CHIP_COMMAND_2 : DSDPV1_REG_CHIP_COMMAND_1;
        wdata_o = acyclic ? chip_2_without : chip_1_without;
      end
      default: ;
    endcase
  end
  always_comb begin
    case (state_q)
      READ_USER: raddr_o = flag_address;
      READ_CHIP_1: raddr_o = DSDPV1_REG_CHIP_COMMAND_1;
      READ_CHIP_2: raddr_o = DSDPV1_REG_CHIP_COMMAND_2;
      CHOICE: raddr_o = base;
      default: raddr_o = address_q;
    endcase
  end
  assign reads_o = reads_area || state_q == READ_USER || state_q == READ_CHIP_1 || state_q == READ_CHIP_2;

  // ---- buffer
  assign baddr_o = state_q == WRITE ? index_q + 8'd1 : first_index;
  assign reply_we_o = arrives_q;
  assign reply_addr_o = index_q;
  assign reply_data_o = state_q == LOOK && (!acyclic || has_data_q) ? limited : rdata_i;

  // ---- beginning of an exchange's reply
  always_comb begin
    case (area_q)
      AREA_PARAMETERS: {function_o, area_o} = {7'h08, exchanges_q, DSDPV1_REG_PRM};
      AREA_CONFIGURATION: {function_o, area_o} = {7'h10, exchanges_q, DSDPV1_REG_CFG};
      AREA_C1: {function_o, area_o} = {7'h02, exchanges_q, DSDPV1_REG_C1};
      AREA_C2: {function_o, area_o} = {7'h04, exchanges_q, DSDPV1_REG_C2};
      default: {function_o, area_o} = {7'd0, exchanges_q, DSDPV1_REG_OUTPUT};
    endcase
  end
  assign count_o = index_q;
endmodule
