// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into cfg_identifier: 15 announces no bytes of the manufacturer.
initial assume (!rst_ni);
always @* assert (skip_q <= 4'd14);
