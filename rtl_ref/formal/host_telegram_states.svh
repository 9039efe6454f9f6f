// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into host_telegram: fields of a telegram. Nothing is judged in the middle of one.
initial assume (!rst_ni);
always @* begin
  assert (field_q <= CRC_LOW);
  if (judged_q) assert (mine_q);
end
