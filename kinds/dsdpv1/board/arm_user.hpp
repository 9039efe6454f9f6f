#pragma once
// Firmware on the ARM board, as the user CPU beside a DSDPV1.

namespace dsdpv1::tb {

/// This program has the ARM board: called before the first scenario is read. What firmware without a mailbox cannot do
/// of a scenario is left out or refused, see untold.hpp.
void add_arm_board();

}  // namespace dsdpv1::tb
