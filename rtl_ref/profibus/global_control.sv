// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Decodes Global_Control (SAP 58; 6.2.6, S4, S24): what it asks of this slave. All 0 when it is to be ignored.
`include "profibus_types.svh"

module global_control (
  `FAULT_PORT
  input  logic [7:0] command_i,
  input  logic [7:0] group_select_i,
  input  logic [7:0] length_i,
  input  logic [7:0] group_ident_i,  // of Set_Prm
  input  logic       sync_req_i,     // of Set_Prm
  input  logic       freeze_req_i,
  input  logic       can_sync_i,     // of the initialisation
  input  logic       can_freeze_i,
  output logic       acts_o,         // it is for this slave
  output logic       clear_o,
  output logic       unsync_o,
  output logic       sync_o,
  output logic       unfreeze_o,
  output logic       freeze_o,
  output logic       unsupported_o   // it asks for what the user has not set
);
  logic legal, addressed, acts, asks_sync, asks_freeze;
  assign legal = length_i == 8'd2 && (command_i & 8'hC1) == 8'h00;
  assign addressed = group_select_i == 8'h00 || (group_select_i &
`ifdef SINGLE_FAULTS
      (`FAULT(174) ? 8'h7F : 8'hFF) &
`endif
      group_ident_i) != 8'h00 || `FAULT(24);
  assign acts = legal && addressed;
  assign acts_o = acts;
  assign clear_o = acts && command_i[1];
  assign unsync_o = acts && command_i[4];
  assign asks_sync = acts && command_i[5] && !command_i[4];
  assign sync_o = asks_sync && (sync_req_i || `FAULT(25));
  assign unfreeze_o = acts && command_i[2];
  assign asks_freeze = acts && command_i[3] && !command_i[2];
  assign freeze_o = asks_freeze && freeze_req_i;
  assign unsupported_o = (asks_sync && !can_sync_i && !`FAULT(121)) || (asks_freeze && !can_freeze_i && !`FAULT(122));
endmodule
