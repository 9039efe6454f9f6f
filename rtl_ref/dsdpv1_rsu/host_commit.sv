// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Commits (4.2, 6.4; SP9, SP16, UA6, UA9 to UA12): a telegram's changes to the DPRAM, one byte a cycle, while no access of the chip runs.
//
// The state says what the next edge does. A byte read at one edge is in rdata_i (bdata_i) at the next. With UART the bytes of a reply go into
// the buffer's other half as they arrive.
`include "dsdpv1_rsu_types.svh"

module host_commit (
  `FAULT_PORT
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        spi_i,
  input  logic        start_i,      // a commit is judged at this edge
  /* verilator lint_off UNUSEDSIGNAL */
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
  localparam logic [3:0] IDLE = 4'd0;
  localparam logic [3:0] PENDING = 4'd1;
  localparam logic [3:0] READ_F = 4'd2;
  localparam logic [3:0] READ_E = 4'd3;
  localparam logic [3:0] READ_V = 4'd4;
  localparam logic [3:0] WRITE = 4'd5;
  localparam logic [3:0] FLAG = 4'd6;
  localparam logic [3:0] CHOICE = 4'd7;
  localparam logic [3:0] HEADER = 4'd8;
  localparam logic [3:0] LOOK = 4'd9;
  localparam logic [3:0] READ = 4'd10;
  localparam logic [3:0] CLEAR = 4'd11;

  logic [3:0] state_q, state_d, first;
  logic exchange, exchange_q, last, spi_exchange;
  assign exchange = telegram_i.ask == ASK_EXCHANGE;
  assign spi_exchange = spi_i && exchange;
  assign first = exchange ? READ_F : telegram_i.ask == ASK_WRITE ? WRITE : READ;

  // ---- choice of the area that is replied (6.4)
  localparam logic [2:0] OUTPUTS = 3'd0;
  localparam logic [2:0] PARAMETERS = 3'd1;
  localparam logic [2:0] CONFIGURATION = 3'd2;
  localparam logic [2:0] C1 = 3'd3;
  localparam logic [2:0] C2 = 3'd4;
  logic [7:0] f_q, e_q, v_q, most;
  logic [2:0] area, area_q;
  logic e_prm, e_cfg, v_c1, v_c2, news, clears_q, exchanges_q, acyclic;
  logic [10:0] base;
  logic [1:0] header_more;  // its bytes after the first
  assign news = telegram_i.area == TO_INPUTS;
  assign {e_cfg, e_prm} = e_q[2:1];
  assign {v_c2, v_c1} = v_q[1:0];
  always_comb begin
    area = OUTPUTS;
    if (news) begin
      if (e_cfg && `FAULT(144)) area = CONFIGURATION;
      else if (e_prm) area = PARAMETERS;
      else if (e_cfg) area = CONFIGURATION;
      else if (v_c1) area = C1;
      else if (v_c2) area = C2;
    end
    case (area)
      PARAMETERS: {base, header_more} = {DSDPV1_REG_PRM, 2'd0};
      CONFIGURATION: {base, header_more} = {DSDPV1_REG_CFG, 2'd2};
      C1: {base, header_more} = {DSDPV1_REG_C1, 2'd3};
      C2: {base, header_more} = {DSDPV1_REG_C2, 2'd3};
      default: {base, header_more} = {DSDPV1_REG_OUTPUT, 2'd0};
    endcase
    case (area_q)
      PARAMETERS: most = 8'd237;
      CONFIGURATION: most = 8'd200;
      C1, C2: most = 8'd240;
      default: most = `FAULT(145) ? 8'd255 : 8'd244;
    endcase
  end
  assign acyclic = area_q == C1 || area_q == C2;

  // ---- length of the area: the header's last byte, as it arrives
  logic has_data_q, empty;
  logic [7:0] limited;
  assign limited = rdata_i > most ? most : rdata_i;
  assign empty = (acyclic && !has_data_q) || rdata_i == 8'd0;

  // ---- next state
  logic [7:0] left_q;
  logic clears;
  assign last = left_q == 8'd1;
  assign clears = exchange_q && clears_q;
  always_comb begin
    state_d = state_q;
    case (state_q)
      IDLE: if (start_i) state_d = owns_i ? PENDING : first;
      PENDING: if (!owns_i) state_d = first;
      READ_F: state_d = READ_E;
      READ_E: state_d = spi_i ? WRITE : READ_V;
      READ_V: state_d = WRITE;
      WRITE: if (last) state_d = exchange_q ? FLAG : IDLE;
      FLAG: state_d = spi_i ? CLEAR : CHOICE;
      CHOICE: state_d = header_more == 2'd0 ? LOOK : HEADER;
      HEADER: if (last) state_d = LOOK;
      LOOK: state_d = !empty ? READ : clears_q ? CLEAR : IDLE;
      READ: if (last) state_d = clears ? CLEAR : IDLE;
      default: state_d = IDLE;
    endcase
  end
  assign busy_o = state_q != IDLE;
  assign waits_o = state_q == PENDING || (start_i && owns_i);
  assign holds_o = state_d != IDLE && !`FAULT(142);

  // ---- bytes
  logic [10:0] address_q;
  logic [7:0] index_q, first_index;  // the buffer's next byte, written or read
  logic arrives_q, e_arrives_q, v_arrives_q, reads_area;
  assign first_index = spi_exchange ? 8'd0 : 8'd1;
  assign reads_area = state_q == CHOICE || state_q == HEADER || state_q == READ;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= IDLE;
      {exchange_q, clears_q, exchanges_q, has_data_q, arrives_q, e_arrives_q, v_arrives_q} <= 7'd0;
      {address_q, left_q, index_q, f_q, e_q, v_q, area_q} <= 54'd0;
    end else begin
      state_q <= state_d;
      arrives_q <= reads_area;
      e_arrives_q <= state_q == READ_E;
      v_arrives_q <= state_q == READ_V;
      if (state_q == READ_E) f_q <= rdata_i;
      if (e_arrives_q) e_q <= rdata_i;
      if (v_arrives_q) v_q <= rdata_i;

      if (start_i) begin
        exchange_q <= exchange;
        clears_q <= spi_i;
        address_q <= spi_exchange ? DSDPV1_REG_INPUT : telegram_i.address;
        left_q <= telegram_i.length + {7'd0, spi_exchange};
        index_q <= telegram_i.ask == ASK_READ ? 8'd0 : first_index;
      end else if (state_q == CHOICE) begin
        area_q <= area;
        exchanges_q <= exchanges_i;
        clears_q <= news && (area != OUTPUTS || e_q[0]);
        address_q <= base + 11'd1;
        left_q <= {6'd0, header_more};
        index_q <= 8'd0;
      end else if (state_q == LOOK) begin
        left_q <= limited;
        index_q <= index_q + 8'd1;
      end else begin
        if (state_q == WRITE || reads_area) begin
          address_q <= address_q + 11'd1;
          left_q <= left_q - 8'd1;
        end
        if (state_q == WRITE || arrives_q) index_q <= index_q + 8'd1;
      end
      if (arrives_q && index_q == 8'd0) has_data_q <= rdata_i == MSAC_WRITE || rdata_i == MSAC_TRANSPORT;
    end
  end

  // ---- DPRAM and buffer
  logic [10:0] flag_address;
  logic [7:0] with_flag, e_without, v_without;
  assign flag_address = telegram_i.area[1] && !spi_i ? DSDPV1_REG_USER_COMMAND_2 : DSDPV1_REG_USER_COMMAND_1;
  assign with_flag =
`ifdef SINGLE_FAULTS
      (`FAULT(217) ? 8'h00 : 8'hFF) &
`endif
      f_q | (telegram_i.area[0] && !spi_i ? 8'h02 : 8'h01);
  always_comb begin
    case (area_q)
      PARAMETERS: e_without = e_q & ~DSDPV1_REG_CHIP_COMMAND_1_PRM;
      CONFIGURATION: e_without = e_q & ~DSDPV1_REG_CHIP_COMMAND_1_CFG;
      default: e_without = e_q & ~DSDPV1_REG_CHIP_COMMAND_1_OUTPUT;
    endcase
    v_without = v_q & (area_q == C1 ? ~DSDPV1_REG_CHIP_COMMAND_2_C1 : ~DSDPV1_REG_CHIP_COMMAND_2_C2);
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
        wdata_o = acyclic ? v_without : e_without;
      end
      default: ;
    endcase
    case (state_q)
      READ_F: raddr_o = flag_address;
      READ_E: raddr_o = DSDPV1_REG_CHIP_COMMAND_1;
      READ_V: raddr_o = DSDPV1_REG_CHIP_COMMAND_2;
      CHOICE: raddr_o = base;
      default: raddr_o = address_q;
    endcase
  end
  assign reads_o = reads_area || state_q == READ_F || state_q == READ_E || state_q == READ_V;
  assign baddr_o = state_q == WRITE ? index_q + 8'd1 : first_index;
  assign reply_we_o = arrives_q;
  assign reply_addr_o = index_q;
  assign reply_data_o = state_q == LOOK && (!acyclic || has_data_q) ? limited : rdata_i;

  always_comb begin
    function_o = {7'd0, exchanges_q};
    case (area_q)
      PARAMETERS: begin
        function_o = {7'h08, exchanges_q};
        area_o = DSDPV1_REG_PRM;
      end
      CONFIGURATION: begin
        function_o = {7'h10, exchanges_q};
        area_o = DSDPV1_REG_CFG;
      end
      C1: begin
        function_o = {7'h02, exchanges_q};
        area_o = DSDPV1_REG_C1;
      end
      C2: begin
        function_o = {7'h04, exchanges_q};
        area_o = DSDPV1_REG_C2;
      end
      default: area_o = DSDPV1_REG_OUTPUT;
    endcase
  end
  assign count_o = index_q;
endmodule
