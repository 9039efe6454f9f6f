// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Writes the answer's characters into the answer memory, one a cycle. The decision only fixes what the answer is; at least 37 cycles
// lie between it and the first start bit, and the sender needs a character every 44, so that it never overtakes.
`include "profibus_types.svh"

module answer_builder (
  `FAULT_PORT
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        abort_i,
  input  logic        start_i,
  input  logic [2:0]  kind_i,
  input  logic [6:0]  da_i,
  input  logic [6:0]  sa_i,
  input  logic [7:0]  fc_i,
  input  logic        to_ssap_i,
  input  logic [7:0]  ssap_i,
  input  logic        from_dsap_i,
  input  logic [7:0]  dsap_i,
  input  logic [2:0]  source_i,
  input  logic [7:0]  length_i,
  input  logic [31:0] diag_i,
  input  logic [15:0] ident_i,
  output logic [7:0]  characters_o,  // of the whole answer, from the edge after the decision on
  output logic        busy_o,
  output logic [7:0]  index_o,   // byte of the source that is needed at the next edge
  input  logic [7:0]  data_i,
  output logic        we_o,
  output logic [7:0]  waddr_o,
  output logic [7:0]  wdata_o
);
  typedef enum logic [3:0] {
    IDLE = 4'd0,
    SD = 4'd1,
    LE = 4'd2,
    LER = 4'd3,
    SD2 = 4'd4,
    DA = 4'd5,
    SA = 4'd6,
    FC = 4'd7,
    DSAP = 4'd8,
    SSAP = 4'd9,
    DIAG = 4'd10,
    DATA = 4'd11,
    FCS = 4'd12,
    ED = 4'd13
  } state_t;

  logic [3:0] state_q, state_d, after_header, after_ssap;
  logic [2:0] kind_q, source_q;
  logic [6:0] da_q, sa_q;
  logic [7:0] fc_q, ssap_q, dsap_q, length_q, sum_q, position_q, count_q;
  logic to_ssap_q, from_dsap_q, last_data, summed;
  logic [47:0] diag_q;
  logic [7:0] diag_byte, value;
  assign diag_byte = diag_q[7:0];
  assign last_data = count_q + 8'd1 == length_q;
  assign summed = state_q >= DA && state_q <= DATA;

  logic [7:0] data_length, le;
  logic [1:0] saps;
  assign saps = {1'b0, to_ssap_q} + {1'b0, from_dsap_q};
  assign data_length = source_q == SRC_DIAG ? length_q + 8'd6 : length_q;
  assign le = data_length + 8'd3 + {6'd0, saps};
  assign characters_o = kind_q == ANS_SC ? 8'd1 : kind_q == ANS_SD1 ? 8'd6 : le + 8'd6;

  assign after_ssap = source_q == SRC_DIAG ? DIAG : DATA;
  assign after_header = kind_q == ANS_SD1 ? FCS : to_ssap_q ? DSAP : after_ssap;

  always_comb begin
    state_d = state_q;
    value = 8'h00;
    case (state_q)
      SD: begin
        value = kind_q == ANS_SC ? 8'hE5 : kind_q == ANS_SD1 ? 8'h10 : 8'h68;
        state_d = kind_q == ANS_SC ? IDLE : kind_q == ANS_SD1 ? DA : LE;
      end
      LE: begin
        value = le;
        state_d = LER;
      end
      LER: begin
        value = le;
        state_d = SD2;
      end
      SD2: begin
        value = 8'h68;
        state_d = DA;
      end
      DA: begin
        value = {kind_q == ANS_SD2 && to_ssap_q, da_q};
        state_d = SA;
      end
      SA: begin
        value = {kind_q == ANS_SD2 && from_dsap_q, sa_q};
        state_d = FC;
      end
      FC: begin
        value = fc_q;
        state_d = after_header;
      end
      DSAP: begin
        value = ssap_q;
        state_d = from_dsap_q ? SSAP : after_ssap;
      end
      SSAP: begin
        value = dsap_q;
        state_d = after_ssap;
      end
      DIAG: begin
        value = diag_byte;
        if (count_q == 8'd5) state_d = length_q == 8'd0 ? FCS : DATA;
      end
      DATA: begin
        value = data_i;
        if (last_data) state_d = FCS;
      end
      FCS: begin
        value = `FAULT(42) ? sum_q + 8'd1 : sum_q;
        state_d = ED;
      end
      ED: begin
        value = 8'h16;
        state_d = IDLE;
      end
      default: state_d = IDLE;  // IDLE itself, and no such state
    endcase
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= IDLE;
      position_q <= 8'd0;
      count_q <= 8'd0;
      sum_q <= 8'd0;
      {kind_q, source_q} <= 6'd0;
      {da_q, sa_q} <= 14'd0;
      {fc_q, ssap_q, dsap_q, length_q} <= 32'd0;
      {to_ssap_q, from_dsap_q} <= 2'd0;
      diag_q <= 48'd0;
    end else if (abort_i) begin
      state_q <= IDLE;
    end else if (start_i) begin
      state_q <= SD;
      position_q <= 8'd0;
      count_q <= 8'd0;
      sum_q <= 8'd0;
      kind_q <= kind_i;
      source_q <= source_i;
      da_q <= da_i;
      sa_q <= sa_i;
      fc_q <= fc_i;
      ssap_q <= ssap_i;
      dsap_q <= dsap_i;
      length_q <= length_i;
      to_ssap_q <= to_ssap_i;
      from_dsap_q <= from_dsap_i;
      diag_q <= {ident_i[7:0], ident_i[15:8], diag_i};
    end else if (state_q != IDLE) begin
      state_q <= state_d;
      position_q <= position_q + 8'd1;
      if (summed) sum_q <= sum_q + value;
      if (state_q == DIAG) diag_q <= {8'd0, diag_q[47:8]};
      if (state_d != state_q) count_q <= 8'd0;
      else count_q <= count_q + 8'd1;
    end
  end

  assign busy_o = state_q != IDLE;
  assign index_o = state_q == DATA ? count_q + 8'd1 : 8'd0;
  assign we_o = state_q != IDLE;
  assign waddr_o = position_q;
  assign wdata_o = value;
endmodule
