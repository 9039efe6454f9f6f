#pragma once
// Real rotation times of the token (T_RR), in ticks.
#include <algorithm>
#include <cstdint>

#include "bus/time.hpp"

namespace dsdpv1::bus {

struct RotationStatistics {
  std::uint64_t count = 0;
  Tick min = kNever, max = 0, sum = 0;

  void add(Tick rotation) {
    ++count;
    min = std::min(min, rotation);
    max = std::max(max, rotation);
    sum += rotation;
  }
  /// 0 without rotations.
  Tick mean() const { return count == 0 ? 0 : sum / static_cast<Tick>(count); }
};

}  // namespace dsdpv1::bus
