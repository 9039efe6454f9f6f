// Checks Set_Prm (SAP 61; 6.2.2, S6, S28, D8, D17) in the order of section 11. The first check that fails decides.
`include "dsdpv1_types.svh"

module set_prm (
  `FAULT_PORT
  input  logic        clk_i,
  /* verilator lint_off UNUSEDSIGNAL */
  input  logic [63:0] head_i,          // first bytes of the telegram's data; reserved bits are not looked at
  /* verilator lint_on UNUSEDSIGNAL */
  input  logic [7:0]  length_i,
  input  logic [15:0] ident_i,         // of the initialisation
  input  logic [3:1]  command_i,       // B024
  input  logic [7:0]  max_length_i,    // B02A
  input  logic [1:0]  mode_i,          // B02B
  input  logic        dpv1_on_i,       // D17
  output logic        unlock_o,
  output logic        min_tsdr_only_o,
  output logic        fault_o,         // Prm_Fault
  output logic        not_supported_o, // ... with Not_Supported
  output logic [7:0]  user_length_o,
  output logic        wd_on_o,
  output logic [7:0]  wd_factor_1_o,
  output logic [7:0]  wd_factor_2_o,
  output logic        wd_base_1ms_o,
  output logic [7:0]  min_tsdr_o,
  output logic [7:0]  group_o,
  output logic        sync_req_o,
  output logic        freeze_req_o,
  output logic        fail_safe_o,
  output logic        dpv1_o
);
  logic [7:3] status;
  logic has_spec, dpv1, user_length_wrong, length_wrong;
  assign status = head_i[7:3];
  assign wd_factor_1_o = head_i[15:8];
  assign wd_factor_2_o = head_i[23:16];
  assign min_tsdr_o = head_i[31:24];
  assign group_o = head_i[55:48];
  assign has_spec = length_i >= 8'd8;
  assign dpv1 = has_spec && head_i[63];
  assign dpv1_o = dpv1;
  assign sync_req_o = status[5];
  assign freeze_req_o = status[4];
  assign wd_on_o = status[3];
  assign fail_safe_o = has_spec && head_i[62];
  assign wd_base_1ms_o = has_spec && head_i[58];
  assign user_length_o = length_i - 8'd7;

  // 237 bytes are all that the area in the DPRAM holds
  assign length_wrong = mode_i == 2'd0 ? user_length_o > max_length_i : mode_i == 2'd1 && user_length_o != max_length_i;
  assign user_length_wrong = (length_wrong && !`FAULT(18)) || user_length_o > 8'd237;

  logic too_short, checked, ident_counts, ident_wrong, unsupported, rest_wrong;
  assign too_short = length_i < 8'd7;
  assign checked = !too_short && !status[6] && status[7];
  assign ident_counts = !too_short && ((status[6] && !`FAULT(120)) || status[7]);
  assign ident_wrong = ident_counts && {head_i[39:32], head_i[47:40]} != ident_i && !`FAULT(19);
  assign unsupported = (sync_req_o && !command_i[2] && !`FAULT(20)) || (freeze_req_o && !command_i[1]) ||
                       (fail_safe_o && !command_i[3]) || (dpv1 && !dpv1_on_i);
  assign rest_wrong = (dpv1 && length_i < 8'd10) ||
                      (wd_on_o && (wd_factor_1_o == 8'd0 || wd_factor_2_o == 8'd0) && !`FAULT(21)) || user_length_wrong;

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
