// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into dsdpv1 (H1, H3, H6, D18). The chip writes only while it owns the DPRAM, as L_REQ and L_STA show. The first move of each access writes 01 into
// B006, and the last write of the start-up access does.
reg owned = 1'b0, count_last = 1'b0, boots_over = 1'b0;
wire at_count = chip_addr == DSDPV1_REG_ACCESS_COUNT;
wire counts = chip_we && at_count && chip_wdata == 8'h01;
always @(posedge clk_i) begin
  owned <= rst_n && l_sta_o;
  boots_over <= rst_n && (boots_over || (owned && !l_sta_o));
  count_last <= rst_n && (chip_we ? counts : count_last);
end
initial assume (!reset_i);
always @* if (rst_n) begin
  if (chip_we) assert (l_req_o && l_sta_o);
  if (boots_over && l_sta_o && !owned) assert (counts);
  if (!boots_over && owned && !l_sta_o) assert (count_last);
end
