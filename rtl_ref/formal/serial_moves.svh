// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into dsdpv1_rsu. A commit writes nothing while the chip is in an access (4.2).
initial assume (!reset_i);
always @* assert (!(host_we && chip_owns));
