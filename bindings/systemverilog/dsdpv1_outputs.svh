// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// Inside of the modules that look at the pins of somebody's RTL: its outputs as one number, see bindings/simulator/simulator.h.
  wire [7:0] singles = {ready_o, br_o, pbf_o, pbrts_o, pbtxd_o, intr0_o, l_sta_o, l_req_o};
  wire [7:0] unknown = {^ready_o === 1'bx, ^br_o === 1'bx, ^pbf_o === 1'bx, ^pbrts_o === 1'bx, ^pbtxd_o === 1'bx, ^intr0_o === 1'bx,
                        ^l_sta_o === 1'bx, ^l_req_o === 1'bx};  // X or Z
  wire d_driven = d_oe_o !== 1'b0;
  wire d_unknown = d_driven && (^{d_oe_o, d_o}) === 1'bx;
  wire [25:0] outputs = {unknown, d_unknown, d_driven, d_driven && !d_unknown ? d_o : 8'h00, singles & ~unknown};
