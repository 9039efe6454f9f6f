// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into dpram_block: a header has at most two bytes after the next one.
always @* if (state_i == SEQ_READ_HEADER) assert (header_q <= 2'd2);
