// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into dpram (P8, P12). The proof follows one byte of the RAM, at any address: its cell is read as it was before the edge, by construction in buffer_ram; all other
// cells are free. A read gives what was written last: the user's writes up to the same edge, the chip's before it.
wire [10:0] watch = $anyconst;
reg [7:0] content = 8'd0, expected = 8'd0, ram = 8'd0, ram_read = 8'd0;
reg watched = 1'b0, ran = 1'b0;
wire [1:0] watch_lane = watch[1:0];
wire [7:0] after_user = user_we_i && user_waddr_i == watch ? user_wdata_i : content;
wire ram_we = we[watch_lane] && waddr[watch_lane*9+:9] == watch[10:2];
wire in_first = first_valid_q && first_addr == watch, in_second = second_valid_q && second_addr == watch;
always @(posedge clk_i) begin
  ran <= ran || rst_ni;
  content <= chip_we_i && chip_addr_i == watch ? chip_wdata_i : after_user;
  expected <= after_user;
  watched <= raddr == watch && rst_ni;
  if (ram_we) ram <= wdata[watch_lane*8+:8];
  ram_read <= ram;
end
initial assume (!rst_ni);
always @* begin
  if (ran) assume (rst_ni);
  if (!rst_ni) assume (!user_we_i && !chip_we_i);
  assume (!(first_stays && second_stays && settles));
  if (watched) assume (rdata[watch_lane*8+:8] == ram_read);
  if (watched) assert (rdata_o == expected);
`ifndef TWIN  // what makes this inductive
  assert (content == (in_second ? second_q[7:0] : in_first ? first_q[7:0] : ram));
  if (second_valid_q) assert (first_valid_q);
  if (watched) assert (ran);
  if (watched) assert (lane_q == watch_lane && expected == (from_queue_q ? newest_q : ram_read));
`endif
end
