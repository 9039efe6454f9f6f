// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into dsdpv1_rsu. Host and chip never own the DPRAM at once (SP12, SP13): claims and all other telegrams are judged when they like.
initial assume (!reset_i);
always @* assert (!(host_owns && chip_owns));
