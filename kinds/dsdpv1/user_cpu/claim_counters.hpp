#pragma once
// What a user CPU's frames over SPI tell about its holds of the DPRAM (SP12, SP13).
#include <cstdint>
#include <vector>

#include "tb/chip/user_cpu/program.hpp"

namespace dsdpv1::user_cpu {

/// Told of each frame, in order. A wait runs from the first claim's frame that was refused to the end of the one that
/// was granted, a hold from there to the end of the release's frame.
class ClaimCounters {
 public:
  /// XSS fell at `begun` and rose at `ended`; as many bytes came in as went out.
  void frame(const std::vector<std::uint8_t>& out, const std::vector<std::uint8_t>& in, Tick begun, Tick ended);
  const HoldCounters& counters() const { return counters_; }

 private:
  HoldCounters counters_;
  Tick asked_at_ = -1, held_at_ = -1;  ///< -1: not
};

}  // namespace dsdpv1::user_cpu
