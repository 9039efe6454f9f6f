// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into msac_buffers: the three requesters' banks and the spare one are four different ones. One telegram is one requester's (msac).
initial assume (!rst_ni);
always @* begin
  assume (accept_i == 3'b000 || accept_i == 3'b001 || accept_i == 3'b010 || accept_i == 3'b100);
  assert (c1_q != c30_q && c1_q != c2f_q && c1_q != spare_q && c30_q != c2f_q && c30_q != spare_q && c2f_q != spare_q);
end
