// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into msac1 (15.1): a request is on its way to the user, or with him, only while it is open. An answer is accepted only from a
// user who has the request (V14: msac).
initial assume (!rst_ni);
always @* begin
  if (answer_i) assume (with_user_o);
  assert (state_q <= ANSWERED);
  if (mail_q || taken_q) assert (state_q == OPEN);
  if (state_q == OPEN) assert (mail_q != taken_q && code_q == MSAC_RIGHT);
end
