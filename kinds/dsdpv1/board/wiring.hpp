#pragma once
// The lines of a DSDPV1 on the ARM board: R_REQ PC6, R_STA PC7, L_REQ PC8, L_STA PC9, RESET PE4, INTR0 PG6, PBF PG12,
// BR PG13, READY PG14 (p).
#include "kinds/board/wiring.hpp"

namespace dsdpv1::tb {

/// The second card of a DSDPV1-RSU has RESET at PE5 and INTR0 at PD12, line 12, IRQ 40.
arm::Wiring dsdpv1_wiring(unsigned card = 1);

}  // namespace dsdpv1::tb
