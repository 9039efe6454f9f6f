// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into baud_search.
reg selected = 1'b0;
reg [3:0] rate_before = 4'd0;
always @(posedge clk_i) begin
  selected <= restart_o;
  rate_before <= rate_q;
end
initial assume (!rst_ni);
always @* begin
  assert (rate_q <= RATE_LAST);
  assert (br_q == !searching_q);
  if (rst_ni && rate_q != rate_before) assert (selected);
  if (!active_q) assert (searching_q);
end
