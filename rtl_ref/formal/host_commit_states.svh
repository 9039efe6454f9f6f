// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into host_commit: states and areas.
initial assume (!rst_ni);
always @* begin
  assert (state_q <= CLEAR);
  assert (area_q <= AREA_C2);
end
