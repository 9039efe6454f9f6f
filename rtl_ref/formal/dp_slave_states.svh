// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into dp_slave: its states and what may hold in each (S13, S15, S18), that Global_Control is heard only
// from the holder in DATA_EXCH, and that a Set_Prm with WD_On is supervised there, wherever it was accepted (S29).
reg init_before = 1'b0, initialised_before = 1'b0, control_before = 1'b0;
always @(posedge clk_i) begin
  init_before <= init;
  initialised_before <= initialised_q;
  control_before <= rst_ni && service_i.execute && service_i.sdn && in_data_exch && from_holder;
end
initial assume (!rst_ni);
always @* begin
  assert (initialised_q == (state_q != DP_OFFLINE));
  if (initialised_q && !initialised_before) assert (init_before);
  assert (pbf_q == (state_q != DP_DATA_EXCH));
  if (await_prm_q) assert (state_q == DP_WAIT_PRM);
  if (await_cfg_q) assert (state_q == DP_WAIT_CFG);
  if (state_q == DP_WAIT_CFG || state_q == DP_DATA_EXCH) assert (held_q);
  if (state_q == DP_WAIT_PRM && held_q) assert (await_prm_q);
  if (state_q == DP_OFFLINE) assert (!held_q);
  if (status_o.global_control) assert (control_before);
  if (sync_q || freeze_q) assert (state_q == DP_DATA_EXCH);
  if (state_q == DP_DATA_EXCH && in_force.wd_on) assert (dp_control_i);
end
