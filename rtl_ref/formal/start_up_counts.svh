// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into dpram_sequencer (H6, 9.7): the start-up access writes B006 twice, 00 at the cell's turn and 01 with its last move.
wire counts = we_o && addr_o == DSDPV1_REG_ACCESS_COUNT;
wire starts_up = state_q == SEQ_RELEASED || state_q == SEQ_CLEAR || state_q == SEQ_VERSION || state_q == SEQ_BOOT_COUNT || state_q == SEQ_BOOT_END;
reg [1:0] written = 2'd0;
always @(posedge clk_i) written <= !rst_ni ? 2'd0 : starts_up && counts && written != 2'd3 ? written + 2'd1 : written;
initial assume (!rst_ni);
always @* if (rst_ni && starts_up) begin
  if (counts && written == 2'd0) assert (wdata_o == 8'h00);
  if (counts && written != 2'd0) assert (written == 2'd1 && wdata_o == 8'h01 && state_q == SEQ_BOOT_COUNT);
  if (state_q == SEQ_BOOT_END) assert (written == 2'd2 && !we_o);
`ifndef TWIN  // what makes this inductive
  if (state_q == SEQ_RELEASED) assert (boot_q == 11'd0 && written == 2'd0);
  if (state_q == SEQ_CLEAR) assert (written == (boot_q > DSDPV1_REG_ACCESS_COUNT ? 2'd1 : 2'd0));
  if (state_q == SEQ_VERSION) assert (boot_q < 11'd4 && written == 2'd1);
  if (state_q == SEQ_BOOT_COUNT) assert (written == 2'd1);
`endif
end
