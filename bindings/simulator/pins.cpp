// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
#include "bindings/simulator/pins.hpp"

#include <fmt/format.h>

namespace dsdpv1::simulator {

std::string level_text(const PinPlace& place, dpsim_level level) {
  if (level == DPSIM_Z) return "Z";
  if (level == DPSIM_X) return "X";
  const bool hex = place.pin == DPSIM_DSDPV1_A || place.pin == DPSIM_DSDPV1_D_IN || place.pin == DPSIM_DSDPV1_D_OUT;
  return hex ? fmt::format("{:02X}", level) : fmt::format("{}", level);
}

std::string time_text(uint64_t tick) {
  const uint64_t cycle = tick / DPSIM_TICKS_PER_CYCLE, rest = tick % DPSIM_TICKS_PER_CYCLE;
  const double us = static_cast<double>(tick) / (1000.0 * DPSIM_TICKS_PER_NS);
  return rest == 0 ? fmt::format("cycle {} ({:.3f} us)", cycle, us)
                   : fmt::format("cycle {} + {} ticks ({:.3f} us)", cycle, rest, us);
}

}  // namespace dsdpv1::simulator
