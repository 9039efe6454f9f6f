// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into dpram_sequencer (H3, H6, D18; 9.1 to 9.7): the chip's moves at B006. Each access writes 01 there, once and with its first move; the start-up access does so with its last one, after it
// has cleared the cell. No other move writes the cell, and none reads it.
wire at_count = addr_o == DSDPV1_REG_ACCESS_COUNT;
wire counts = we_o && at_count;
wire reads = state_q == SEQ_USER_1 || state_q == SEQ_USER_2 || state_q == SEQ_CHIP_1 || state_q == SEQ_CHIP_2 || state_q == SEQ_ENABLE || state_q == SEQ_CHOICE ||
             state_q == SEQ_READ_HEADER || state_q == SEQ_READ_BYTES || state_q == SEQ_READ_CRC_HIGH || state_q == SEQ_READ_CRC_LOW;
reg owned = 1'b0, started_up = 1'b0, counted = 1'b0;
wire first = owns_o && !owned, ends = owned && !owns_o;
always @(posedge clk_i) begin
  owned <= rst_ni && owns_o;
  started_up <= rst_ni && (started_up || ends);
  counted <= rst_ni && owns_o && (we_o ? counts && wdata_o == 8'h01 : counted);  // with the last write
end
initial assume (!rst_ni);
always @* if (rst_ni) begin
  if (state_q == SEQ_VERSION) assume (boot_q < 11'd4);  // start_up_counts
  if (counts && !started_up) assert (wdata_o == 8'h00 || (wdata_o == 8'h01 && state_q == SEQ_BOOT_COUNT));
  if (ends && !started_up) assert (counted);
  if (first && started_up) assert (counts && wdata_o == 8'h01);
  if (counts && started_up) assert (first);
  if (reads) assert (!at_count);
end
