#pragma once
// The user CPU that a scenario asks for beside a DSDPV1: a C++ program, or firmware on the ARM board.
#include "tb/bench/chip_maker.hpp"

namespace tb {

/// ChipMaker::make_user. What firmware without a mailbox cannot do of the scenario is left out or refused, see
/// untold.hpp.
MakeUser make_dsdpv1_user(const UserRequest& request);

}  // namespace tb
