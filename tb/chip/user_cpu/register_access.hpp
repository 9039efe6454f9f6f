#pragma once
#include <cstdint>

#include "bus/time.hpp"

namespace dsdpv1::user_cpu {

/// An access of a user CPU to a register or cell of its chip, at the tick at which it acts; a read with its answer.
struct RegisterAccess {
  bus::Tick at = 0;
  std::uint16_t address = 0;
  std::uint8_t value = 0;
  bool write = false;
};

}  // namespace dsdpv1::user_cpu
