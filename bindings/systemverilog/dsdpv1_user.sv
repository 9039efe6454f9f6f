// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// A user CPU on the pins of a DSDPV1, model or RTL, as a bus functional model: accesses with the times of table 15, ownership by R_REQ and
// R_STA (H2), blocks with their CRC (4.2). Only one process may call the tasks.
module dsdpv1_user #(
  parameter integer DPV1 = 0,           // 1: initialise enables DPV1, requests are fetched with get_request
  parameter longint SETUP_PS = 20000,   // A, D, CSR before the strobe falls
  parameter longint STROBE_PS = 50000,  // RD, WR low: Tw >= 31.25 ns, Ts >= 12.5 ns
  parameter longint HOLD_PS = 20000,    // A, D, CSR after it: Td >= 12.5 ns
  parameter longint LOOK_PS = 100000    // from R_REQ to each sample of L_REQ and L_STA
) (
  output logic        r_req_o,
  output logic        r_sta_o,
  input  logic        l_req_i,
  input  logic        l_sta_i,
  output logic [10:0] a_o,
  output logic [7:0]  d_o,    // Z when it drives nothing
  input  logic [7:0]  d_i,    // D as the chip drives it
  output logic        csr_o,
  output logic        rd_o,
  output logic        wr_o
);
  /* verilator no_inline_module */  // its 5.006 scales the delays of an inlined module by the parent's time unit
  timeunit 1ps;
  timeprecision 1ps;
  import dsdpv1_pkg::*;

  logic [7:0] d = 8'h00;
  logic driven = 1'b0;
  assign d_o = driven ? d : 8'hzz;

  initial begin
    r_req_o = 1'b0;
    r_sta_o = 1'b0;
    a_o = 11'h000;
    driven = 1'b0;
    csr_o = 1'b1;
    rd_o = 1'b1;
    wr_o = 1'b1;
  end

  // All delays are in a process of this module: Verilator 5.006 scales those of a task by the time unit of its caller.
  longint pause_ps = 0;
  int pauses = 0, ends = 0;
  always @(pauses) ends <= #(pause_ps) pauses;
  task pause(input longint ps);
    pause_ps = ps;
    pauses = pauses + 1;
    @(ends);
  endtask

  // Waits until the user owns the DPRAM; each hold begins by counting B006 (note 1 of table 2).
  task take;
    logic [7:0] count;
    r_req_o = 1'b1;
    pause(LOOK_PS);
    while (l_req_i !== 1'b0 || l_sta_i !== 1'b0) pause(LOOK_PS);
    r_sta_o = 1'b1;
    pause(LOOK_PS);
    read_cell(11'h006, count);
    write_cell(11'h006, count + 8'd1);
  endtask

  task give;
    r_sta_o = 1'b0;
    r_req_o = 1'b0;
    pause(LOOK_PS);
  endtask

  task write_cell(input logic [10:0] address, input logic [7:0] value);
    a_o = address;
    d = value;
    driven = 1'b1;
    csr_o = 1'b0;
    pause(SETUP_PS);
    wr_o = 1'b0;
    pause(STROBE_PS);
    wr_o = 1'b1;
    pause(HOLD_PS);
    csr_o = 1'b1;
    driven = 1'b0;
    pause(HOLD_PS);
  endtask

  task read_cell(input logic [10:0] address, output logic [7:0] value);
    a_o = address;
    csr_o = 1'b0;
    pause(SETUP_PS);
    rd_o = 1'b0;
    pause(STROBE_PS);
    value = d_i;
    rd_o = 1'b1;
    pause(HOLD_PS);
    csr_o = 1'b1;
    pause(HOLD_PS);
  endtask

  // CRC-16 of 4.2 (D2): 0xA001 reflected, from 0xFFFF.
  function logic [15:0] crc16(input logic [15:0] crc, input logic [7:0] value);
    integer shift;
    crc16 = crc ^ {8'h00, value};
    for (shift = 0; shift < 8; shift = shift + 1) crc16 = crc16[0] ? (crc16 >> 1) ^ 16'hA001 : crc16 >> 1;
  endfunction

  // Writes a block of `count` bytes at `address` and its CRC at `crc_address`. The user owns the DPRAM.
  task write_block_at(input logic [10:0] address, input bytes_t block, input int count, input logic [10:0] crc_address);
    logic [15:0] crc;
    int i;
    crc = 16'hFFFF;
    for (i = 0; i < count; i = i + 1) begin
      write_cell(address + i[10:0], block[i]);
      crc = crc16(crc, block[i]);
    end
    write_cell(crc_address, crc[15:8]);
    write_cell(crc_address + 11'd1, crc[7:0]);
  endtask

  // As above, then writes `command` into B010.
  task write_block(input logic [10:0] address, input bytes_t block, input int count, input logic [10:0] crc_address,
                   input logic [7:0] command);
    write_block_at(address, block, count, crc_address);
    write_cell(11'h010, command);
  endtask

  // Waits for B004 = C5.
  task wait_ready;
    logic [7:0] flag;
    flag = 8'h00;
    while (flag !== 8'hC5) begin
      pause(64'd20000000);
      take;
      read_cell(11'h004, flag);
      give;
    end
  endtask

  // Writes the initialisation block (table 12): lengths at their limits; the chip judges the parameters by their length and the
  // configuration by comparison (modes 0 and 1). `done`: whether the chip has accepted it.
  task initialise(input int address, input int ident, input bytes_t cfg, input int cfg_size, output int done);
    bytes_t block;
    logic [7:0] status;
    int i;
    block = 2048'd0;
    block[0] = 8'd14 + cfg_size[7:0];
    block[1] = address[7:0];
    block[2] = ident[15:8];
    block[3] = ident[7:0];
    block[4] = 8'h0F;   // Set_Slave_Address, Freeze, Sync, Fail_Safe
    block[7] = 8'd244;  // inputs
    block[8] = 8'd244;  // outputs
    block[9] = 8'd32;   // user diagnosis
    block[10] = 8'd237; // user parameters
    block[12] = 8'd200; // configuration
    block[13] = 8'd1;
    block[14] = cfg_size[7:0];
    for (i = 0; i < cfg_size; i = i + 1) block[15 + i] = cfg[i];
    take;
    write_cell(11'h005, DPV1 != 0 ? 8'h1D : 8'h00);
    write_block(11'h020, block, 15 + cfg_size, 11'h0F7, 8'h04);
    give;
    pause(64'd20000000);
    take;
    read_cell(11'h00A, status);
    give;
    done = status[0] === 1'b1 ? 1 : 0;
  endtask

  // Writes inputs for the master.
  task give_inputs(input bytes_t inputs, input int count);
    bytes_t block;
    int i;
    block = 2048'd0;
    block[0] = count[7:0];
    for (i = 0; i < count; i = i + 1) block[1 + i] = inputs[i];
    take;
    write_block(11'h130, block, 1 + count, 11'h225, 8'h01);
    give;
  endtask

  // Reads outputs of the master; `count` 0: no new ones. Checks their CRC (4.1.2).
  task get_outputs(output bytes_t outputs, output int count);
    logic [7:0] value, crc_high, crc_low;
    logic [15:0] crc;
    int i;
    outputs = 2048'd0;
    count = 0;
    take;
    read_cell(11'h00E, value);
    if (value[0] === 1'b1) begin
      read_cell(11'h319, value);
      count = {24'd0, value};
      crc = crc16(16'hFFFF, value);
      for (i = 0; i < count; i = i + 1) begin
        read_cell(11'h31A + i[10:0], value);
        outputs[i] = value;
        crc = crc16(crc, value);
      end
      read_cell(11'h40E, crc_high);
      read_cell(11'h40F, crc_low);
      if (crc !== {crc_high, crc_low}) $error("%m: the CRC of the outputs is %h%h, expected %h", crc_high, crc_low, crc);
      read_cell(11'h00E, value);
      write_cell(11'h00E, value & 8'hFE);
    end
    give;
  endtask

  // ---- acyclic requests (7.2, 7.3). `channel` 0: MSAC_C1, area B5D0; 1: MSAC_C2, area B6D0. Bit `channel` of B00F announces a request,
  // ---- that of B011 an answer

  logic [7:0] asked [0:7];  // the header of each channel's request: Function_Num, slot, index, length; an answer repeats it (V6)

  function logic [10:0] area(input int channel);
    area = channel == 0 ? 11'h5D0 : 11'h6D0;
  endfunction

  // Fetches a request. `service`: DS_READ, DS_WRITE, DS_TRANSPORT of dsdpv1_pkg, 0: none. `data`, `count`: bytes to write or transport; for
  // a read `count` is the number of bytes requested. Checks its CRC (4.1.2).
  task get_request(input int channel, output int service, output int slot, output int index, output bytes_t data, output int count);
    logic [7:0] value, crc_high, crc_low;
    logic [15:0] crc;
    int i;
    data = 2048'd0;
    service = 0;
    take;
    read_cell(11'h00F, value);
    if (value[channel] === 1'b1) begin
      crc = 16'hFFFF;
      for (i = 0; i < 4; i = i + 1) begin
        read_cell(area(channel) + i[10:0], value);
        asked[4 * channel + i] = value;
        crc = crc16(crc, value);
      end
      service = {24'd0, asked[4 * channel]};
      slot = {24'd0, asked[4 * channel + 1]};
      index = {24'd0, asked[4 * channel + 2]};
      count = {24'd0, asked[4 * channel + 3]};
      for (i = 0; service != DS_READ && i < count; i = i + 1) begin
        read_cell(area(channel) + 11'd4 + i[10:0], value);
        data[i] = value;
        crc = crc16(crc, value);
      end
      read_cell(area(channel) + 11'h0F4, crc_high);
      read_cell(area(channel) + 11'h0F5, crc_low);
      if (crc !== {crc_high, crc_low}) $error("%m: the CRC of the request is %h%h, expected %h", crc_high, crc_low, crc);
      read_cell(11'h00F, value);
      write_cell(11'h00F, value & ~(8'h01 << channel));
    end
    give;
  endtask

  task send_answer(input int channel, input bytes_t block, input int count);
    logic [7:0] value;
    take;
    read_cell(11'h00F, value);
    if (value[channel] !== 1'b1) begin  // else the answer would destroy a newer request (V13)
      read_cell(11'h011, value);
      write_block_at(area(channel), block, count, area(channel) + 11'h0F4);
      write_cell(11'h011, value | (8'h01 << channel));
    end
    give;
  endtask

  // Answers the last request: `data` are the bytes read or transported; ignored for a write, which is answered as complete.
  task answer(input int channel, input bytes_t data, input int count);
    bytes_t block;
    int i;
    block = 2048'd0;
    for (i = 0; i < 4; i = i + 1) block[i] = asked[4 * channel + i];
    if ({24'd0, block[0]} == DS_WRITE) send_answer(channel, block, 4);
    else begin
      block[3] = count[7:0];
      for (i = 0; i < count; i = i + 1) block[4 + i] = data[i];
      send_answer(channel, block, 4 + count);
    end
  endtask

  // Refuses the last request (tables 28, 29): ACCESS_... of dsdpv1_pkg.
  task refuse(input int channel, input int error_code_1, input int error_code_2);
    bytes_t block;
    block = 2048'd0;
    block[0] = asked[4 * channel] | 8'h80;
    block[1] = 8'h80;
    block[2] = error_code_1[7:0];
    block[3] = error_code_2[7:0];
    send_answer(channel, block, 4);
  endtask
endmodule
