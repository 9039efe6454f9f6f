// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into telegram_rx.
initial assume (!rst_ni);
always @* begin
  assert (state_q <= COMPLETE);
  assert (field_q <= ED);
  assert (sd_q <= SD_SC);
end
