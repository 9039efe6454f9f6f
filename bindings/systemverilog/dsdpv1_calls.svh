// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// One source for both interfaces: `DSDPV1(model_step)(...) is the DPI function dsdpv1_model_step of dsdpv1_pkg, or with DSDPV1_VPI
// defined (Icarus) the system function $dsdpv1_model_step of dsdpv1.vpi.
`ifndef DSDPV1_CALLS_SVH
`define DSDPV1_CALLS_SVH
`ifdef DSDPV1_VPI
`define DSDPV1(name) $dsdpv1_``name
`define DSDPV1_TEXT reg [16383:0]
`define DSDPV1_IMPORTS
`else
`define DSDPV1(name) dsdpv1_``name
`define DSDPV1_TEXT string
`define DSDPV1_IMPORTS import dsdpv1_pkg::*;
`endif
`endif
