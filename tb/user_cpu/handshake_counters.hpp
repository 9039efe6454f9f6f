#pragma once
// What a user CPU's handshake pins tell about its holds of the DPRAM.
#include <algorithm>
#include <cstdint>
#include <utility>

#include "bus/time.hpp"

namespace user_cpu {

using bus::Tick;

/// Times in ticks. A wait runs from R_REQ's rise to R_STA's, a hold from R_STA's rise to the time that both are low
/// again (H1).
struct PortCounters {
  std::uint64_t holds = 0;
  std::uint64_t given_up = 0;  ///< both low again without having had the DPRAM
  Tick longest_wait = 0;
  Tick longest_hold = 0;

  PortCounters& operator+=(const PortCounters& other) {
    holds += other.holds;
    given_up += other.given_up;
    longest_wait = std::max(longest_wait, other.longest_wait);
    longest_hold = std::max(longest_hold, other.longest_hold);
    return *this;
  }
};

/// Told of each change of the two pins, in order of time.
class HandshakeCounters {
 public:
  void r_req(Tick at, bool level) {
    if (level) asked_at_ = at;
    if (std::exchange(r_req_, level) && !level) lowered(at);
  }
  void r_sta(Tick at, bool level) {
    if (std::exchange(r_sta_, level) && !level) lowered(at);
    if (!level || std::exchange(held_, true)) return;
    held_at_ = at;
    ++counters_.holds;
    counters_.longest_wait = std::max(counters_.longest_wait, at - asked_at_);
  }
  Tick asked_at() const { return asked_at_; }
  const PortCounters& counters() const { return counters_; }

 private:
  /// One of the two fell; they may fall in either order.
  void lowered(Tick at) {
    if (r_req_ || r_sta_) return;
    if (std::exchange(held_, false))
      counters_.longest_hold = std::max(counters_.longest_hold, at - held_at_);
    else
      ++counters_.given_up;
  }

  PortCounters counters_;
  Tick asked_at_ = 0;  ///< R_REQ rose
  Tick held_at_ = 0;   ///< R_STA rose
  bool r_req_ = false, r_sta_ = false, held_ = false;
};

}  // namespace user_cpu
