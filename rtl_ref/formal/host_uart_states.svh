// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into host_uart: receiver, its samples, and bits of a character that is sent.
initial assume (!rst_ni);
always @* begin
  assert (state_q != 2'd3);
  assert (sample_q <= 4'd11);
  if (state_q == RECEIVING) assert (sample_q <= 4'd10);
  assert (bit_q <= 4'd10);
  assert (!sends_q || answers_q);
end
