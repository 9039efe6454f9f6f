// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into fdl. Each character that the sender takes was in the answer memory two edges before, as the memory is read one edge before. The sender begins with index 0 after
// an order, takes a character at the fifth edge after it at the earliest (8.3: the 37th), and then at most one in five (sent_whole: one in 44). The builder writes
// a character at each edge, and no more than 255 of them, as LE is 249 at most.
reg [7:0] index_before = 8'd0;
reg [2:0] since = 3'd0;  // edges since the order or the last character
reg [1:0] idle = 2'd2;   // edges since the builder's last write
reg ordered = 1'b0;
wire takes_character = send_index_i != index_before && !ordered;
wire [8:0] written = {1'b0, builder_waddr};
wire [8:0] sent = {1'b0, send_index_i};
always @(posedge clk_i) begin
  index_before <= rst_ni ? send_index_i : 8'd0;
  ordered <= rst_ni && send_o;
  since <= send_o || takes_character ? 3'd0 : since == 3'd4 ? 3'd4 : since + 3'd1;
  idle <= !rst_ni || abort_i ? 2'd2 : builder_busy_o ? 2'd0 : idle == 2'd2 ? 2'd2 : idle + 2'd1;
end
initial assume (!rst_ni);
always @* begin
  if (ordered || !rst_ni) assume (send_index_i == 8'd0);
  else assume (send_index_i == index_before || (send_index_i == index_before + 8'd1 && since == 3'd4));
  assume (send_index_i != 8'd255 && !(builder_busy_o && builder_waddr == 8'd255));
  if (rst_ni && takes_character) assert (idle == 2'd2 || written >= sent + 9'd2);
`ifndef TWIN  // what makes this inductive
  if (rst_ni && (builder_busy_o || idle == 2'd0)) assert (written >= sent + (takes_character ? 9'd2 : {6'd0, since}));
  if (rst_ni && idle == 2'd1 && !builder_busy_o && !takes_character) assert (written + 9'd1 >= sent + {6'd0, since});
  assert (since <= 3'd4 && idle <= 2'd2 && (idle == 2'd0 || !builder_busy_o || builder_waddr == 8'd0));
  if (rst_ni && ordered) assert (since == 3'd0);
`endif
end
