#pragma once
#include <cstdint>

#include "bus/time.hpp"
#include "tb/chip/user_cpu/user_side.hpp"

namespace dsdpv1::spc3_user {

using bus::Tick;

/// A chip of the SPC3 family as its user CPU sees it: one byte at a tick, with all effects of the access, and no bus
/// (ruling A16).
class RegisterCall : public user_cpu::UserSide {
 public:
  virtual std::uint8_t load(Tick at, std::uint16_t address) = 0;
  virtual void store(Tick at, std::uint16_t address, std::uint8_t value) = 0;
};

}  // namespace dsdpv1::spc3_user
