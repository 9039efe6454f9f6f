// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into msac2_channel (15.2). An answer is accepted only for a BUSY channel, Initiate takes a FREE one (msac2),
// and Idle is not a valid request (request_check).
initial assume (!rst_ni);
always @* begin
  if (answer_i) assume (state_q == C2_BUSY);
  if (initiate_i) assume (free_o);
  if (idle_i) assume (!right_i);
  assert (state_q <= C2_ABORTED);
  if (state_q == C2_OPEN || state_q == C2_BUSY || state_q == C2_ANSWERED) assert (code_q == MSAC_RIGHT);
  if (state_q == C2_BUSY) assert (!idle_q);
  if (state_q == C2_ABORTED) assert (reason_q == ABORT_SEQUENCE || reason_q == ABORT_INVALID_PDU || reason_q == ABORT_TIMEOUT);
end
