// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into msac2 (15.2): the area in the DPRAM is of one channel at most, and a request is on its way to the user, or with him, only
// while it is of one.
initial assume (!rst_ni);
always @* begin
  assert (owner_q != 2'b11);
  assert ((owner_q != 2'b00) == (mail_q != taken_q));
  assert (!(mail_q && taken_q));
end
