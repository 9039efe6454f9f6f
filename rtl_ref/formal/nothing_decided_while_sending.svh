// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into station. While PBRTS is high no telegram is decided: the receiver stands still (8.3), and the rise of PBRTS forgets a
// telegram in progress (section 7). uart_tx is free except for the property that uart_tx_states proves: risen is the first cycle of PBRTS.
reg rts_before = 1'b0;
always @(posedge clk_i) rts_before <= rst_ni && pbrts_o;
initial assume (!rst_ni);
always @* begin
  assume (risen == (pbrts_o && !rts_before));
  assert (!(decide && pbrts_o));
end
