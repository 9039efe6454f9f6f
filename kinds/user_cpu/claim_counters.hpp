#pragma once
// Statistics of a user CPU's holds of the DPRAM, derived from its frames over SPI (SP12, SP13).
#include <cstdint>
#include <vector>

#include "tb/chip/user_cpu/program.hpp"

namespace dsdpv1::user_cpu {

/// Receives each frame, in order. A wait runs from the frame of the first refused claim to the end of the granted one,
/// a hold from there to the end of the release's frame.
class ClaimCounters {
 public:
  /// XSS fell at `begun` and rose at `ended`; `in` has as many bytes as `out`.
  void frame(const std::vector<std::uint8_t>& out, const std::vector<std::uint8_t>& in, Tick begun, Tick ended);
  const HoldCounters& counters() const { return counters_; }

 private:
  HoldCounters counters_;
  Tick asked_at_ = -1, held_at_ = -1;  ///< -1: none
};

}  // namespace dsdpv1::user_cpu
