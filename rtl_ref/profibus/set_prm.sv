// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Checks Set_Prm (SAP 61; 6.2.2, S6, S28, D8, D17) in the order of section 11. The first check that fails decides.
`include "profibus_types.svh"

module set_prm #(
  parameter logic [7:0] MAX_PRM = MOST_PRM  // user parameters that the user's side can take
) (
  `FAULT_PORT
  input  logic        clk_i,
  /* verilator lint_off UNUSEDSIGNAL */  // reserved bits are ignored
  input  logic [63:0] head_i,          // first bytes of the telegram's data; reserved bits are ignored
  /* verilator lint_on UNUSEDSIGNAL */
  input  logic [7:0]  length_i,
  /* verilator lint_off UNUSEDSIGNAL */  // address, configuration and the like are others'
  input  initialise_t initial_i,       // the initialisation in force: ident, what is supported, limit, mode
  /* verilator lint_on UNUSEDSIGNAL */
  input  logic        dpv1_on_i,       // D17
  output logic        unlock_o,
  output logic        min_tsdr_only_o,
  output logic        fault_o,         // Prm_Fault
  output logic        not_supported_o, // ... with Not_Supported
  output logic [7:0]  user_length_o,
  output prm_t        prm_o
);
  logic [7:3] status;
  logic has_spec, dpv1, fail_safe, user_length_wrong, length_wrong;
  logic [7:0] wd_factor_1, wd_factor_2;
  assign status = head_i[7:3];
  assign has_spec = length_i >= 8'd8;
  assign dpv1 = has_spec && head_i[63];
  assign fail_safe = has_spec && head_i[62];
  assign wd_factor_1 = head_i[15:8];
  assign wd_factor_2 = head_i[23:16];
  assign prm_o.wd_on = status[3];
  assign prm_o.wd_factor_1 = wd_factor_1;
  assign prm_o.wd_factor_2 = wd_factor_2;
  assign prm_o.wd_base_1ms = has_spec && head_i[58];
  assign prm_o.min_tsdr = head_i[31:24];
  assign prm_o.group = head_i[55:48];
  assign prm_o.sync_req = status[5];
  assign prm_o.freeze_req = status[4];
  assign prm_o.fail_safe = fail_safe;
  assign prm_o.dpv1 = dpv1;
  assign user_length_o = length_i - 8'd7;

  assign length_wrong = initial_i.prm_mode == 2'd0 ? user_length_o > initial_i.max_prm
                                                   : initial_i.prm_mode == 2'd1 && user_length_o != initial_i.max_prm;
  assign user_length_wrong = (length_wrong && !`FAULT(18)) || user_length_o > MAX_PRM;

  logic too_short, checked, ident_counts, ident_wrong, unsupported, rest_wrong;
  assign too_short = length_i < 8'd7;
  assign checked = !too_short && !status[6] && status[7];
  assign ident_counts = !too_short && ((status[6] && !`FAULT(120)) || status[7]);
  assign ident_wrong = ident_counts && {head_i[39:32], head_i[47:40]} != initial_i.ident && !`FAULT(19);
  assign unsupported = (status[5] && !initial_i.sync && !`FAULT(20)) || (status[4] && !initial_i.freeze) ||
                       (fail_safe && !initial_i.fail_safe) || (dpv1 && !dpv1_on_i);
  assign rest_wrong =
`ifdef SINGLE_FAULTS
      (`FAULT(188) && dpv1 && length_i == 8'd10) ||
`endif
      (dpv1 && length_i < 8'd10) ||
                      (status[3] && (wd_factor_1 == 8'd0 || wd_factor_2 == 8'd0) && !`FAULT(21)) || user_length_wrong;

  // The bytes stand still long before the decision: all checks are taken through registers
  logic unlock_q, min_tsdr_only_q, fault_q, unsupported_q;
  always_ff @(posedge clk_i) begin
    unlock_q <= !too_short && status[6] && !ident_wrong;
    min_tsdr_only_q <= !too_short && !status[6] && !status[7];
    fault_q <= too_short || ident_wrong || (checked && (unsupported || rest_wrong));
    unsupported_q <= checked && !ident_wrong && unsupported;
  end

  assign unlock_o = unlock_q;
  assign min_tsdr_only_o = min_tsdr_only_q;
  assign fault_o = fault_q;
  assign not_supported_o = unsupported_q;
endmodule
