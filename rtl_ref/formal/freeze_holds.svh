// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into user_banks (S4, S24). While freeze holds, the inputs that masters get, a bank or cleared, change only with another Freeze or Unfreeze, the end of
// DATA_EXCH, a configuration with other inputs that comes into use, or an initialisation.
reg held = 1'b0, ended = 1'b0, zero_before = 1'b0;
reg [1:0] bank_before = 2'd0;
always @(posedge clk_i) begin
  held <= rst_ni && hold_i;
  ended <= copy_i || leave_i || end_leave_i || clear_commit_i || clear_telegram_i || init_i;
  bank_before <= in2_q;
  zero_before <= in2_zero_q;
end
initial assume (!rst_ni);
always @* if (rst_ni && held && !ended) assert (in2_q == bank_before && in2_zero_q == zero_before);
