// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// FDL (8.2; S3, S20, S26, S32): which telegrams are for this station, repetitions, and the memory of the last answer. The answer itself
// is written by answer_builder while the wait for TSDR runs.
`include "profibus_types.svh"

module fdl (
  `FAULT_PORT
  input  logic        fcb_rule_i,     // S26: 0 letter, 1 content
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        decide_i,
  input  logic        searching_i,
  input  logic        forget_i,       // a rate is selected: the memory is dropped
  input  logic        abort_i,        // initialisation
  input  logic [2:0]  sd_i,
  input  logic        synced_i,
  input  logic [7:0]  da_i,
  input  logic [7:0]  sa_i,
  input  logic [6:0]  fc_i,
  input  logic [7:0]  dsap_i,
  input  logic [7:0]  ssap_i,
  input  logic        saps_ok_i,
  input  logic [7:0]  length_i,       // bytes after the SAPs
  input  logic [7:0]  fcs_i,
  input  logic [6:0]  address_i,
  input  logic        from_holder_i,
  output logic        any_telegram_o,    // a synced SD1, SD2 or SD3 is decided
  output logic        trigger_o,         // one to the own address
  output logic        trigger_holder_o,
  output service_t    service_o,
  input  answer_t     answer_i,
  input  logic [31:0] answer_diag_i,
  input  logic [15:0] ident_i,
  output logic        builder_busy_o,
  output logic [7:0]  builder_index_o,
  input  logic [7:0]  builder_data_i,
  output logic        send_o,         // an answer to the telegram decided at this edge
  input  logic [7:0]  send_index_i,
  output logic [7:0]  send_data_o,
  output logic [7:0]  send_length_o   // characters, from the second edge after the decision on
);
  // Signals that depend only on the telegram are stable long before the decision, so they pass through registers
  logic own, own_q, broadcast_q, request_q, saps_ok_q, sdn_q, srd_q, refuse_q, fdl_status_q, fcb_q, fcv_q, same_series_q, same_saps_q, same_rest_q;
  logic from_nobody_q;  // SA 127
  logic kind_q, default_sap_q;
  logic memory_valid_q;
  logic [7:0] length_q;
  logic [3:0] function_code;
  logic fcb, fcv, content;
  assign function_code = fc_i[3:0];
  assign fcb = fc_i[5];
  assign fcv = fc_i[4];
  assign content = fcb_rule_i || `FAULT(165);

  // The fields that identify a repetition of the last request (S26): SA and FCB; for content also FC, SAPs or their absence, length and FCS
  logic [17:0] saps, memory_saps_q;
  logic [7:0] memory_data_length_q, memory_fcs_q, dsap, ssap;
  logic [6:0] memory_sa_q, memory_fc_q;
  assign dsap = da_i[7] ? dsap_i : 8'd0;
  assign ssap = sa_i[7] ? ssap_i : 8'd0;
  assign saps = {da_i[7], sa_i[7], dsap, ssap};
  logic same_sa, same_fcb, same_fc, same_dsap, same_ssap, same_length, same_fcs;
  assign same_sa = memory_sa_q == sa_i[6:0] || `FAULT(112);
  assign same_fcb =
`ifdef SINGLE_FAULTS
      (`FAULT(167) && same_fcs) ||
`endif
      memory_fc_q[5] == fcb || `FAULT(39);
  assign same_fc =
`ifdef SINGLE_FAULTS
      (`FAULT(167) && {memory_fc_q[6], memory_fc_q[4:0]} == {fc_i[6], fc_i[4:0]}) ||
`endif
      memory_fc_q == fc_i || `FAULT(39);
  assign same_dsap = {memory_saps_q[17], memory_saps_q[15:8]} == {saps[17], saps[15:8]} || `FAULT(113);
  assign same_ssap = {memory_saps_q[16], memory_saps_q[7:0]} == {saps[16], saps[7:0]} || `FAULT(114);
  assign same_length = memory_data_length_q == length_i || `FAULT(115);
  assign same_fcs = memory_fcs_q == fcs_i || `FAULT(116);

  assign own = da_i[6:0] == address_i;
  always_ff @(posedge clk_i) begin
    own_q <= own;
    broadcast_q <= da_i[6:0] == 7'd127;
    from_nobody_q <= sa_i[6:0] == 7'd127;
    request_q <= fc_i[6] && (synced_i || `FAULT(38));
    saps_ok_q <= saps_ok_i;
    kind_q <= sd_i == SD_SD1 || sd_i == SD_SD2 || sd_i == SD_SD3;
    sdn_q <= function_code == 4'h4 || function_code == 4'h6;
    srd_q <= function_code == 4'hC || function_code == 4'hD;
    refuse_q <= function_code != 4'h4 && function_code != 4'h6 && function_code != 4'h9 && function_code != 4'hC &&
                function_code != 4'hD;  // S29
    fdl_status_q <= function_code == 4'h9;
`ifdef SINGLE_FAULTS
    if (`FAULT(184) && function_code == 4'h6) begin
      sdn_q <= 1'b0;
      refuse_q <= 1'b1;
    end
`endif
    default_sap_q <= !da_i[7];
    fcb_q <= fcb;
    fcv_q <= fcv;
    same_series_q <= same_sa && same_fcb && !`FAULT(40);
    same_saps_q <= same_dsap && same_ssap;
    same_rest_q <= same_fc && same_length && same_fcs;
  end

  logic legal_q, repetition_q, ignored_q;
  always_ff @(posedge clk_i) begin
    legal_q <= kind_q && (own_q || (broadcast_q && sdn_q)) && request_q && saps_ok_q && (!from_nobody_q || `FAULT(107));
    ignored_q <= kind_q && own_q && request_q && saps_ok_q && from_nobody_q;
    repetition_q <= own_q && (fcv_q || `FAULT(118)) && memory_valid_q && same_series_q &&
                    (content ? same_saps_q && same_rest_q : !sdn_q || `FAULT(163));
`ifdef SINGLE_FAULTS
    if (`FAULT(169) && !default_sap_q && dsap_i == SAP_READ_INPUTS) repetition_q <= 1'b0;
`endif
  end

  logic legal, execute, answered, sends;
  assign any_telegram_o = decide_i && kind_q && synced_i && !(from_nobody_q && `FAULT(110));
  assign legal = decide_i && !searching_i && legal_q;
  assign trigger_o = (legal && own_q) || (decide_i && !searching_i && ignored_q && `FAULT(108));
  assign trigger_holder_o = trigger_o && (from_holder_i || `FAULT(108));
  assign execute = legal && !repetition_q;
  assign service_o.execute = execute;
  assign service_o.refuse = refuse_q;
  assign service_o.fdl_status = fdl_status_q;
  assign service_o.srd = srd_q;
  assign service_o.sdn = sdn_q;
  assign service_o.default_sap = default_sap_q;
  // Every service but an SDN has an answer: so the sender need not wait for the kind of it
  assign answered = !sdn_q || (`FAULT(84) && answer_i.kind != ANS_NONE);
  assign sends = execute && answered;
  assign send_o = legal && (answered || (repetition_q && `FAULT(163)));

  logic [7:0] built_length;
  logic built_q;  // the edge after the decision
  logic to_ssap, from_dsap;
  assign to_ssap = sa_i[7];
  assign from_dsap = sa_i[7] && da_i[7];

  // There is one answer: the memory, valid or not, and what is sent
  logic counts, unanswered;
  assign counts = fcv_q || (!content && fcb_q && !`FAULT(162)) || `FAULT(118);
  assign unanswered = execute && (own_q || `FAULT(161)) && sdn_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      memory_valid_q <= 1'b0;
      memory_sa_q <= 7'd0;
      memory_fc_q <= 7'd0;
      memory_saps_q <= 18'd0;
      memory_data_length_q <= 8'd0;
      memory_fcs_q <= 8'd0;
      length_q <= 8'd0;
      built_q <= 1'b0;
    end else begin
      if (sends && (fcv_q || !`FAULT(117))) begin
        memory_valid_q <= counts;
        memory_sa_q <= sa_i[6:0];
        memory_fc_q <= fc_i;
        memory_saps_q <= saps;
        memory_data_length_q <= length_i;
        memory_fcs_q <= fcs_i;
      end
      built_q <= sends;
      if (built_q) length_q <= built_length;
      if (built_q && !own && !content && !`FAULT(164)) memory_valid_q <= 1'b0;  // the request has changed it
      if (unanswered && (content ? `FAULT(119) : !`FAULT(160))) memory_valid_q <= 1'b0;
      if (forget_i && !`FAULT(41)) memory_valid_q <= 1'b0;
      if (decide_i && ignored_q && `FAULT(109)) memory_valid_q <= 1'b0;
    end
  end

  logic builder_we;
  logic [7:0] builder_waddr, builder_wdata;
  answer_builder u_builder (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .abort_i(abort_i), .start_i(sends), .kind_i(answer_i.kind), .da_i(sa_i[6:0]),
    .sa_i(address_i), .fc_i(answer_i.fc), .to_ssap_i(to_ssap), .ssap_i(ssap_i), .from_dsap_i(from_dsap), .dsap_i(dsap_i),
    .source_i(answer_i.source), .length_i(answer_i.length), .diag_i(answer_diag_i), .ident_i(ident_i),
    .characters_o(built_length), .busy_o(builder_busy_o), .index_o(builder_index_o), .data_i(builder_data_i),
    .we_o(builder_we), .waddr_o(builder_waddr), .wdata_o(builder_wdata));

  buffer_ram #(.ADDRESS_BITS(8), .BYTES(256)) u_answers (
    .clk_i(clk_i), .we_i(builder_we), .waddr_i(builder_waddr), .wdata_i(builder_wdata),
    .raddr_i(send_index_i), .rdata_o(send_data_o));

  assign send_length_o = length_q;
endmodule
