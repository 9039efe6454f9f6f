#pragma once
// Makes the user CPU that a scenario selects for a DSDPV1: a C++ program, or firmware on the ARM board, which not every
// program has.
#include "kinds/dsdpv1/user_cpu/host_bus.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::tb {

using MakeArmUser = MakeUser (*)(const UserRequest& request, user_cpu::HostBus& host);

/// Called by a program that has the ARM board, before the first scenario is read.
void set_arm_maker(MakeArmUser make);

/// ChipKind::make_user. Throws InputError for an ARM board in a program without.
MakeUser make_dsdpv1_user(const UserRequest& request);

}  // namespace dsdpv1::tb
