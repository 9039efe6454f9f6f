// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The CRC of the block that an item moves (D2, D3): of bytes that are written at this edge, or of read ones as they arrive, and the comparison
// with the user's.
`include "dpram_types.svh"

module dpram_crc (
  `FAULT_PORT `CRC_COUNTS_PORT
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        starts_i,   // an access, at this edge
  input  seq_t        state_i,
  input  item_t       item_i,
  input  item_t       pick_i,     // the item that the choice begins
  input  logic        arrives_i,  // a byte that the CRC covers
  input  logic [7:0]  rdata_i,
  input  logic [7:0]  wdata_i,    // is written at this edge
  input  logic        last_i,     // ... the last
  input  logic [7:0]  length_i,
  output logic [15:0] crc_o,
  output logic        wrong_o
);
  logic chooses, begins_read;
  assign chooses = state_i == SEQ_CHOICE;
  assign begins_read = is_user_block(pick_i);

  // ---- over the covered bytes; that of a written block begins with the byte that the choice writes
  logic writes, drops_last;
  logic [7:0] covered;
  logic [15:0] crc_q, crc_next, crc_start, crc_first;
  assign drops_last = state_i == SEQ_WRITE_BYTES && item_i == ITEM_C2_REQUEST && last_i && `FAULT(89);
  assign writes = (state_i == SEQ_WRITE_INPUT_LENGTH || state_i == SEQ_WRITE_LENGTH || state_i == SEQ_WRITE_BYTES) && !drops_last;
  assign covered = arrives_i ? rdata_i : wdata_i;
  assign crc_start =
`ifdef SINGLE_FAULTS
      `FAULT(170) && pick_i == ITEM_C2_REQUEST ? 16'h0000 :
`endif
      `FAULT(55) ? 16'h0000 : 16'hFFFF;
  crc16 u_next (.crc_i(crc_q), .byte_i(covered), .crc_o(crc_next));
  crc16 u_first (.crc_i(crc_start), .byte_i(wdata_i), .crc_o(crc_first));
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) crc_q <= 16'd0;
    else if (chooses) crc_q <= begins_read ? crc_start : crc_first;
    else if (arrives_i || (writes && !`FAULT(56))) crc_q <= crc_next;
  end

  // ---- the user's, as its bytes arrive
  logic [7:0] crc_high, crc_low;
  logic high_arrives_q, low_arrives, high_wrong, low_wrong, clears, wrong_q;
  assign {crc_high, crc_low} = crc_q;
  assign low_arrives = state_i == SEQ_READ_LAST;
  assign high_wrong = high_arrives_q && rdata_i != crc_high `AND_CRC_COUNTS;
  assign low_wrong = low_arrives && rdata_i != crc_low && !`FAULT(57) `AND_CRC_COUNTS;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) high_arrives_q <= 1'b0;
    else high_arrives_q <= state_i == SEQ_READ_CRC_HIGH;
  end
  assign clears = (`FAULT(201) ? starts_i : chooses) || (`FAULT(203) && (high_arrives_q || low_arrives) && length_i == 8'd0);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) wrong_q <= 1'b0;
    else if (clears) wrong_q <= 1'b0;
    else if (high_wrong || low_wrong) wrong_q <= 1'b1;
  end

  assign crc_o = crc_q;
  assign wrong_o = wrong_q;
endmodule
