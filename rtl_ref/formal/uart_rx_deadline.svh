// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into uart_rx: the deadline of a character is at least six edges after it was complete.
reg [4:0] recent = 5'd0;
always @(posedge clk_i) recent <= rst_ni ? {recent[3:0], valid_o} : 5'd0;
initial assume (!rst_ni);
always @* if (rst_ni && (valid_o || recent != 5'd0)) assert (!due_o);
