// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into dp_slave (S4, S24). Sync and freeze hold until an executed Global_Control ends them or DATA_EXCH is left, and only a Global_Control copies outputs or inputs:
// so sync_holds and freeze_holds are about all that comes between.
wire control = service_i.execute && service_i.sdn && !service_i.default_sap && dsap_i == SAP_GLOBAL_CONTROL;
wire [7:0] command = head_i[7:0];
reg sync_before = 1'b0, freeze_before = 1'b0, unsync = 1'b0, unfreeze = 1'b0, left_before = 1'b0;
always @(posedge clk_i) begin
  sync_before <= rst_ni && status_o.state == DP_DATA_EXCH && sync_q;
  freeze_before <= rst_ni && status_o.state == DP_DATA_EXCH && freeze_q;
  unsync <= control && command[4];
  unfreeze <= control && command[2];
  left_before <= left_o || commands_i.initialise.commit;
end
initial assume (!rst_ni);
always @* if (rst_ni) begin
  if (sync_before && !unsync && !left_before) assert (sync_q);
  if (freeze_before && !unfreeze && !left_before) assert (freeze_q);
  if (decision.copy_outputs) assert (control && (command[4] || command[5]));
  if (decision.copy_inputs) assert (control && (command[2] || command[3]));
end
