// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Assembles telegrams (section 7; S3, S10) from characters and signals when one is decided.
//
// Fields are kept until the next telegram begins. The bytes after the SAPs are passed on as they arrive; the first eight are
// also kept.
`include "profibus_types.svh"

module telegram_rx (
  `FAULT_PORT
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        restart_i,  // a rate is selected at this edge: nothing is decided
  input  logic        risen_i,    // PBRTS rose at the last edge, after the decision
  input  logic        valid_i,    // a character, as uart_rx gives it
  input  logic [7:0]  char_i,
  input  logic        ok_i,
  input  logic        syn_i,
  input  logic        gap_i,
  input  logic        busy_i,
  input  logic        due_i,
  output logic        begin_o,    // the first character of a telegram is taken at this edge
  output logic        decide_o,   // the telegram in the fields is decided at this edge
  output logic [2:0]  sd_o,
  output logic        synced_o,
  output logic [7:0]  da_o,
  output logic [7:0]  sa_o,
  output logic [6:0]  fc_o,       // bit 7 is ignored
  output logic [7:0]  dsap_o,
  output logic [7:0]  ssap_o,
  output logic        saps_ok_o,  // the SAP bytes that DA and SA announce are there
  output logic [7:0]  length_o,   // bytes after the SAPs
  output logic [7:0]  fcs_o,
  output logic [63:0] head_o,     // the first eight of them, the first lowest
  output logic        data_valid_o,  // a byte after the SAPs, at this edge
  output logic [7:0]  data_index_o,
  output logic [7:0]  data_o
);
  typedef enum logic [1:0] {
    NONE = 2'd0,
    RECEIVING = 2'd1,
    COMPLETE = 2'd2
  } state_t;

  // Fields in the order of a telegram
  typedef enum logic [3:0] {
    LE = 4'd0,
    LER = 4'd1,
    SD2 = 4'd2,
    DA = 4'd3,
    SA = 4'd4,
    FC = 4'd5,
    DATA = 4'd6,
    FCS = 4'd7,
    ED = 4'd8
  } field_t;

  logic [1:0] state_q;
  logic [3:0] field_q;
  logic [2:0] sd_q;
  logic synced_q, fcs_ok_q;
  logic [7:0] le_q, data_length_q, data_count_q, sum_q;
  // Always data_length_q - sap_count: both are known long before a decision, so no subtraction stands in its path
  logic [7:0] length_q;
  logic [6:0] fc_q;
  logic [7:0] da_q, sa_q, dsap_q, ssap_q;
  logic [63:0] head_q;

  logic in_telegram, first, next, legal_start;
  assign in_telegram = state_q != NONE;
  assign first = valid_i && (in_telegram ? syn_i : gap_i);
  assign next = valid_i && in_telegram && !syn_i;
  assign legal_start = char_i == 8'h10 || char_i == 8'h68 || char_i == 8'hA2 || char_i == 8'hDC || char_i == 8'hE5;
  assign begin_o = first;

  // SAP bytes and what follows
  logic [7:0] sap_count;
  logic is_dsap, is_ssap, is_service_data, last_data;
  assign sap_count = {6'd0, {1'b0, da_q[7]} + {1'b0, sa_q[7]}};
  assign is_dsap = da_q[7] && data_count_q == 8'd0;
  assign is_ssap =
`ifdef SINGLE_FAULTS
      !(`FAULT(183) && !da_q[7]) &&
`endif
      sa_q[7] && data_count_q == {7'd0, da_q[7]};
  assign is_service_data = next && ok_i && !gap_i && state_q == RECEIVING && field_q == DATA && !is_dsap && !is_ssap;
  assign last_data = data_count_q + 8'd1 == data_length_q;
  assign data_valid_o = is_service_data;
  assign data_index_o = data_count_q - sap_count;
  assign data_o = char_i;

  assign decide_o = due_i && !busy_i && !valid_i && !restart_i && !risen_i && state_q == COMPLETE;

  logic gap_void, sum_wrong, end_wrong;
  assign gap_void = gap_i && !`FAULT(9);
  assign sum_wrong = char_i != sum_q && !`FAULT(10);
  assign end_wrong = char_i != 8'h16 && !`FAULT(11);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= NONE;
      field_q <= LE;
      sd_q <= SD_SC;
      synced_q <= 1'b0;
      fcs_ok_q <= 1'b0;
      le_q <= 8'd0;
      data_length_q <= 8'd0;
      length_q <= 8'd0;
      data_count_q <= 8'd0;
      sum_q <= 8'd0;
      da_q <= 8'd0;
      sa_q <= 8'd0;
      fc_q <= 7'd0;
      dsap_q <= 8'd0;
      ssap_q <= 8'd0;
    end else if (restart_i || risen_i) begin
      state_q <= NONE;
    end else if (first) begin
      state_q <= !ok_i || !legal_start ? NONE : char_i == 8'hE5 ? COMPLETE : RECEIVING;
      field_q <= char_i == 8'h68 ? LE : DA;
      synced_q <= syn_i || `FAULT(12);
      sum_q <= 8'd0;
      data_count_q <= 8'd0;
      data_length_q <= char_i == 8'hA2 ? 8'd8 : 8'd0;
      length_q <= (char_i == 8'hA2 ? 8'd8 : 8'd0) - sap_count;
      case (char_i)
        8'h10: sd_q <= SD_SD1;
        8'h68: sd_q <= SD_SD2;
        8'hA2: sd_q <= SD_SD3;
        8'hDC: sd_q <= SD_SD4;
        default: sd_q <= SD_SC;
      endcase
    end else if (next) begin
      if (state_q == COMPLETE || gap_void || !ok_i) begin
        state_q <= state_q == COMPLETE && ok_i && `FAULT(13) ? COMPLETE : NONE;
      end else begin
        if (field_q == DA || field_q == SA || field_q == FC || field_q == DATA) sum_q <= sum_q + char_i;
        case (field_q)
          LE: begin
            le_q <= char_i;
            field_q <= LER;
          end
          LER: begin
            if ((char_i != le_q && !`FAULT(14)) || le_q < 8'd4 || le_q > 8'd249) state_q <= NONE;
            data_length_q <= le_q - 8'd3;
            length_q <= le_q - 8'd3 - sap_count;
            field_q <= SD2;
          end
          SD2: begin
            if (char_i != 8'h68) state_q <= NONE;
            field_q <= DA;
          end
          DA: begin
            da_q <= char_i;
            length_q <= data_length_q - {6'd0, {1'b0, char_i[7]} + {1'b0, sa_q[7]}};
            field_q <= SA;
          end
          SA: begin
            sa_q <= char_i;
            length_q <= data_length_q - {6'd0, {1'b0, da_q[7]} + {1'b0, char_i[7]}};
            field_q <= FC;
            if (sd_q == SD_SD4) state_q <= COMPLETE;
          end
          FC: begin
            fc_q <= char_i[6:0];
            field_q <= sd_q == SD_SD1 ? FCS : DATA;
          end
          DATA: begin
            if (is_dsap) dsap_q <= char_i;
            else if (is_ssap) ssap_q <= char_i;
            data_count_q <= data_count_q + 8'd1;
            if (last_data) field_q <= FCS;
          end
          FCS: begin
            fcs_ok_q <= !sum_wrong;
            field_q <= ED;
          end
          default: state_q <= fcs_ok_q && !end_wrong ? COMPLETE : NONE;
        endcase
`ifdef SINGLE_FAULTS
        if (`FAULT(182) && field_q == LER && le_q == 8'd249) state_q <= NONE;
`endif
      end
    end else if (due_i && !busy_i) begin
      state_q <= NONE;  // decided, or a gap
    end
  end

  always_ff @(posedge clk_i) begin
    if (is_service_data && data_index_o < 8'd8) begin
      case (data_index_o)
        8'd0: head_q[7:0] <= char_i;
        8'd1: head_q[15:8] <= char_i;
        8'd2: head_q[23:16] <= char_i;
        8'd3: head_q[31:24] <= char_i;
        8'd4: head_q[39:32] <= char_i;
        8'd5: head_q[47:40] <= char_i;
        8'd6: head_q[55:48] <= char_i;
        default: head_q[63:56] <= char_i;
      endcase
    end
  end

  assign sd_o = sd_q;
  assign synced_o = synced_q;
  assign da_o = da_q;
  assign sa_o = sa_q;
  assign fc_o = fc_q;
  assign dsap_o = dsap_q;
  assign ssap_o = ssap_q;
  assign saps_ok_o = data_length_q >= sap_count;
  assign length_o = length_q;
  assign fcs_o = sum_q;
  assign head_o = head_q;
endmodule
