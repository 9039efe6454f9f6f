// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into serial_port. ... and reads nothing.
always @* begin
  assume (uart_i || !(uart_take || spoil || silence));  // by construction in host_uart
  assert (!(commit_reads && owns_i));
end
