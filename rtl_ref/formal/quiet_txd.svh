// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into host_uart.
reg replying = 1'b0;
always @(posedge clk_i) replying <= rst_ni && (judged_i || (replying && !all_sent));
initial assume (!rst_ni);
always @* if (!replying) assert (txd_o);
