#pragma once
// Statistics of a user CPU's holds of the DPRAM, derived from its handshake pins.
#include <algorithm>
#include <utility>

#include "tb/chip/user_cpu/program.hpp"

namespace dsdpv1::user_cpu {

/// Receives each change of the two pins, in order of time. A wait runs from R_REQ's rise to R_STA's, a hold from
/// R_STA's rise until both are low again (H1).
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
  const HoldCounters& counters() const { return counters_; }

 private:
  /// One of the two fell; they may fall in either order.
  void lowered(Tick at) {
    if (r_req_ || r_sta_) return;
    if (std::exchange(held_, false))
      counters_.longest_hold = std::max(counters_.longest_hold, at - held_at_);
    else
      ++counters_.given_up;
  }

  HoldCounters counters_;
  Tick asked_at_ = 0;  ///< R_REQ rose
  Tick held_at_ = 0;   ///< R_STA rose
  bool r_req_ = false, r_sta_ = false, held_ = false;
};

}  // namespace dsdpv1::user_cpu
