#pragma once
// Firmware on the ARM board as the user CPU of a DSDPV1.

namespace dsdpv1::tb {

/// Registers the ARM board, and the reader of host processes' lines; call it before the first scenario is read. Parts
/// of a scenario that firmware without a mailbox cannot execute are left out or rejected, see ../chip/untold.hpp.
void add_arm_board();

}  // namespace dsdpv1::tb
