// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// Binds the assertions to every instance of the RTL's top, for simulators and formal tools. Define DSDPV1_TOP if it has another name; it
// has the reference RTL's port names and the parameters RTS_LEAD, INTR_LOW, INTR_GAP.
`ifndef DSDPV1_TOP
`define DSDPV1_TOP dsdpv1
`endif
bind `DSDPV1_TOP dsdpv1_assertions #(.RTS_LEAD(RTS_LEAD), .INTR_LOW(INTR_LOW), .INTR_GAP(INTR_GAP)) u_dsdpv1_assertions (.*);
