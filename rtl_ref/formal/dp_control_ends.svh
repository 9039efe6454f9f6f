// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into watchdog (S1, S22). Without a telegram of the holder and a new Set_Prm each edge in DP_CONTROL either leaves it or makes the rest of its time
// smaller: {outer, inner, base}, the first the most significant. So it ends after a finite number of edges. The base time is any of 3 cycles or more.
wire kept = accept_dp_i || commit_dp_i || trigger_holder_i || found_i;
wire [47:0] rest = {outer_q, inner_q, base_q}, rest_next = {outer_d, inner_d, base_d};
initial assume (!rst_ni);
always @* begin
  assume (dp_base >= 32'd3);
  if (rst_ni && state_q == WD_DP_CONTROL && !kept && state_d == WD_DP_CONTROL && !load_dp_q) assert (rest_next < rest);
`ifndef TWIN  // what makes this inductive
  if (state_q == WD_DP_CONTROL && !load_dp_q) assert (base_start_q >= 32'd2 && (last_q || rest != 48'd0));
  if (state_q == WD_DP_CONTROL) assert (!load_baud_q);
  assert (state_q <= WD_DP_CONTROL);
`endif
end
