#pragma once
// Firmware on the ARM board as the host of an XGate-DPS10, by USART2 or SPI1.

namespace dsdpv1::xgate {

/// Registers the ARM board; call it before the first scenario is read. Parts of a scenario that firmware without a
/// mailbox cannot execute are left out or rejected, see kinds/board/untold.hpp.
void add_arm_board();

}  // namespace dsdpv1::xgate
