// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into serial_port. A reply lasts from its telegram's judgement to the frame's end.
reg replying = 1'b0;
wire replies_now = replying || judgement.replies;
always @(posedge clk_i) replying <= rst_ni && replies_now && !frame_ends;
initial assume (!rst_ni);
always @* begin
  assume (spi_i && !uart_i);
  if (load && !replies_now) assert (reply_byte == 8'hFF);
end
