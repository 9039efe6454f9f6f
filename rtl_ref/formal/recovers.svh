// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into any block. All registers begin with any values, as an upset may leave them: `LEGAL is true at each edge after one with `EVENT, whatever the inputs do.
reg happened = 1'b0;
always @(posedge clk_i) happened <= `EVENT;
always @* if (happened) assert (`LEGAL);
