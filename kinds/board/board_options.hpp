#pragma once
// From a scenario to its ARM board, for any kind of chip.
#include "kinds/board/board.hpp"
#include "kinds/board/board_keys.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::tb {

/// Processor, firmware and debugger by keys and request. The wiring and the mailbox are the kind's. Throws InputError,
/// with the scenario's line, for a file without firmware.
arm::BoardOptions board_options(const UserRequest& request, const BoardKeys& board);

}  // namespace dsdpv1::tb
