// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into bus_banks (S4, S18, S27). A telegram's bytes begin before it is decided, and a decision uses them once: telegram_rx. From its
// first byte to its decision the bank of reception is none of the six that are in use.
reg receives = 1'b0;
wire decided = prm_i || cfg_i || store_i || accept_cfg_i;
always @(posedge clk_i) receives <= rst_ni && (begin_i || (receives && !decided));
initial assume (!rst_ni);
always @* begin
  if (decided) assume (receives && !begin_i);
  if (accept_cfg_i) assume (cfg_i);  // dp_service
  if (rst_ni && receives) assert (receive_q != out1_q && receive_q != out2_q && receive_q != prm_q && receive_q != last_q && receive_q != in_use_q &&
                        receive_q != transfer_q);
end
