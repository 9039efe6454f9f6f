// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Diagnosis of the user (6.2.4; D9, D14, S23): its type's bits, its length and whether it waits to be read. The bytes are in
// sap_buffers. Outputs with _now include a commit at this edge.
`include "profibus_types.svh"

module diagnosis (
  `FAULT_PORT
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       init_i,       // an initialisation is committed
  input  diagnosis_t diagnosis_i,  // a block of the user is committed
  input  logic [7:0] max_length_i, // of the initialisation
  input  logic       read_i,       // the holding master is sent it
  output logic       store_o,      // the commit's block is taken
  output logic       ext_diag_now_o,
  output logic       stat_diag_now_o,
  output logic       waiting_now_o,
  output logic [7:0] length_now_o
);
  logic ext_q, stat_q, waiting_q;
  logic [7:0] length_q;
  logic external, static_diag, extended, legal;

  assign external = diagnosis_i.kind == DIAG_EXTERNAL;
  assign static_diag = diagnosis_i.kind == DIAG_STATIC;
  assign extended = diagnosis_i.kind == DIAG_EXTENDED;  // ends external diagnosis
  assign legal = diagnosis_i.kind != DIAG_UNKNOWN;
  assign store_o =
`ifdef SINGLE_FAULTS
      !(`FAULT(192) && diagnosis_i.length == max_length_i) &&
`endif
      diagnosis_i.commit && legal && diagnosis_i.length <= max_length_i;

  assign ext_diag_now_o = store_o && (external || (extended && !`FAULT(158))) ? external && diagnosis_i.present : ext_q;
  assign stat_diag_now_o = store_o && ((static_diag && !`FAULT(26)) || (extended && `FAULT(159))) ? static_diag && diagnosis_i.present : stat_q;
  assign waiting_now_o = waiting_q || (store_o && (external || static_diag));
  assign length_now_o = store_o ? diagnosis_i.length : length_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      ext_q <= 1'b0;
      stat_q <= 1'b0;
      waiting_q <= 1'b0;
      length_q <= 8'd0;
    end else if (init_i) begin
      ext_q <= 1'b0;
      stat_q <= 1'b0;
      waiting_q <= 1'b0;
      length_q <= 8'd0;
    end else begin
      ext_q <= ext_diag_now_o;
      stat_q <= stat_diag_now_o;
      waiting_q <= waiting_now_o && (!read_i || `FAULT(27));
      length_q <= length_now_o;
    end
  end
endmodule
