#pragma once
// Makes the user CPU that a scenario selects for a DSDPV1: a C++ program, or firmware on the ARM board, which not every
// program has, or a process of this computer.
#include <string>

#include "kinds/dsdpv1/user_cpu/callers.hpp"
#include "kinds/user_cpu/host_bus.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::tb {

using MakeArmUser = MakeUser (*)(const UserRequest& request, user_cpu::HostBus& host);
using ReadLines = user_cpu::PlaceOf (*)(const std::string& program);

/// What the codes of the driver begin with.
constexpr const char* kDriverErrors = "DSDPV1_ERR_";

/// Called by a program that has the ARM board, before the first scenario is read.
void set_arm_maker(MakeArmUser make);
/// The same for the lines of host processes. Without it their places are not known.
void set_line_reader(ReadLines read);

/// ChipKind::make_user. Throws InputError for an ARM board in a program without.
MakeUser make_dsdpv1_user(const UserRequest& request);

}  // namespace dsdpv1::tb
