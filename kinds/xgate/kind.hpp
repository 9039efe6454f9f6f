#pragma once
// The XGate-DPS10 as a kind of chip (docs/xgate.md), made with the kit.
#include "tb/kit/slave_kit.hpp"

namespace dsdpv1::xgate {

const kit::Kind& kind();

/// Called by a program that has the ARM board, before the first scenario is read.
using MakeArmUser = tb::MakeUser (*)(const tb::UserRequest& request);
void set_arm_maker(MakeArmUser make);

}  // namespace dsdpv1::xgate
