#pragma once
// The SPC3 family as kinds of chips: apc3, spc3 and vpc3 (docs/spc3.md).
#include "kinds/user_cpu/host_bus.hpp"
#include "model/spc3/variant.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::tb {

const ChipKind& kind_of(spc3::Variant variant);

/// Called by a program that has the ARM board, before the first scenario is read.
using MakeSpc3ArmUser = MakeUser (*)(const UserRequest& request, user_cpu::HostBus& pins);
void set_spc3_arm_maker(MakeSpc3ArmUser make);

}  // namespace dsdpv1::tb
