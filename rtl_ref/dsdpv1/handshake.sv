// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The four wires by which user and chip share the DPRAM (5.1; H1, H2, P9). From R_REQ and R_STA the sequencer gets only whether
// the user holds it. Both L_REQ and L_STA show whether the chip owns it.
`include "dsdpv1_types.svh"

module handshake (
  `FAULT_PORT
  input  logic clk_i,
  input  logic r_req_i,       // asynchronous; the synchronisers run during reset, too
  input  logic r_sta_i,
  output logic l_req_o,
  output logic l_sta_o,
  output logic user_holds_o,  // asks for the DPRAM or holds it: either pin is enough (H1)
  input  logic owns_i         // the chip; from a register, as the pins are
);
  logic r_req, r_sta, r_sta_seen;
  synchroniser #(.POWER_ON(1'b0)) u_r_req (.clk_i(clk_i), .d_i(r_req_i), .q_o(r_req));
  synchroniser #(.POWER_ON(1'b0)) u_r_sta (.clk_i(clk_i), .d_i(r_sta_i), .q_o(r_sta_seen));
  assign r_sta = `FAULT(96) ? r_sta_i : r_sta_seen;
`ifdef SINGLE_FAULTS
  logic r_req_first_q = 1'b0;
  always_ff @(posedge clk_i) r_req_first_q <= r_req_i;
`endif

  assign user_holds_o =
`ifdef SINGLE_FAULTS
      `FAULT(206) ? r_req_first_q || r_sta_seen :
`endif
      (r_req && !`FAULT(49)) || (r_sta && !`FAULT(95));
  assign l_req_o = owns_i;
  assign l_sta_o = owns_i;
endmodule
