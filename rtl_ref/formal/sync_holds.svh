// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into bus_banks (S4, S24). While sync holds, the outputs that the user gets, a bank or cleared, change only with another Sync or Unsync, Clear_Data, the end of
// DATA_EXCH, a configuration that comes into use, or an initialisation.
reg held = 1'b0, ended = 1'b0, zero_before = 1'b0;
reg [2:0] bank_before = 3'd0;
always @(posedge clk_i) begin
  held <= rst_ni && hold_i;
  ended <= copy_i || clear_i || leave_i || end_leave_i || commit_accept_cfg_i || accept_cfg_i || init_i;
  bank_before <= out2_o;
  zero_before <= out2_zero_o;
end
initial assume (!rst_ni);
always @* if (rst_ni && held && !ended) assert (out2_o == bank_before && out2_zero_o == zero_before);
