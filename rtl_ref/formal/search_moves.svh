// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into baud_search (S1). While the rate is searched each edge finds it, selects the next one, or makes the rest of the window smaller. The next one of 9 is 0.
wire searches = active_q && searching_q;
reg ended = 1'b0;
reg [3:0] rate_before = 4'd0;
always @(posedge clk_i) begin
  ended <= rst_ni && restart_o && !start_i;
  rate_before <= rate_q;
end
initial assume (!rst_ni);
always @* begin
  assume (window_of_rate >= 32'd2);
  if (rst_ni && searches && !restart_o && !found_o && !loads_q) assert (window_d < window_q);
  if (rst_ni && ended) assert (rate_q == (rate_before == RATE_LAST ? 4'd0 : rate_before + 4'd1));
end
