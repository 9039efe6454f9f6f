// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into watchdog.
initial assume (!rst_ni);
always @* begin
  assert (state_q <= WD_DP_CONTROL);
  if (waits_q) assert (state_q == WD_OFF);
end
