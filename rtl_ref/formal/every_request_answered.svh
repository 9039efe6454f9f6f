// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into station: fdl sends an answer to whatever it executes but an SDN, so one has to be there (S20). telegram_rx is free except for
// what it does by its construction: nothing is decided in the cycle in which a rate is selected.
always @* begin
  assume (!(decide && restart));
  if (service.execute) assert ((answer.kind == ANS_NONE) == service.sdn);
end
