#pragma once
// Firmware on the ARM board as the user CPU of a chip of the SPC3 family: XCS at NE1, XREADY at NWAIT (PD6), or XSS,
// SCK, MISO, MOSI at PA4 to PA7; RESET at PE4, X/INT at PG6, XDATAEXCH at PG12 (p).

namespace dsdpv1::tb {

/// Registers the ARM board; call it before the first scenario is read. This firmware has no mailbox: parts of a
/// scenario that need one are left out or rejected, see kinds/board/untold.hpp.
void add_spc3_arm_board();

}  // namespace dsdpv1::tb
