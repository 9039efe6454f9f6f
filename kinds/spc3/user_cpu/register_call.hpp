#pragma once
#include "bus/time.hpp"
#include "tb/chip/user_cpu/register_port.hpp"
#include "tb/chip/user_cpu/user_side.hpp"

namespace dsdpv1::spc3_user {

using bus::Tick;

/// A chip of the SPC3 family as its user CPU sees it: one byte at a tick, with all effects of the access, and no bus
/// (ruling A16).
class RegisterCall : public user_cpu::UserSide, public tb::RegisterPort {};

}  // namespace dsdpv1::spc3_user
