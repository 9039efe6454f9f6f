#pragma once
// An output whose pin follows its register later: RtlTiming::delayed.
#include <deque>

#include "cosim/rtl.hpp"

namespace dsdpv1::cosim {

/// From one level to the other the pin comes `delay` ticks later; what releases it or drives it again acts at once, and
/// what is on its way is dropped.
class DelayedOutput {
 public:
  explicit DelayedOutput(Tick delay) : delay_(delay) {}

  /// The register changes. True: so does the pin, now.
  bool change(Tick at, Level then, Level now) {
    if (now != tb::kLevelZ && then != tb::kLevelZ) {
      coming_.push_back({at + delay_, now});
      return false;
    }
    coming_.clear();
    level_ = now;
    return true;
  }
  /// When the pin changes by itself; the level that it has from then on.
  Tick next() const { return coming_.empty() ? bus::kNever : coming_.front().at; }
  Level take() {
    level_ = coming_.front().level;
    coming_.pop_front();
    return level_;
  }
  Level level() const { return level_; }

 private:
  struct Change {
    Tick at;
    Level level;
  };
  const Tick delay_;
  Level level_ = tb::kLevelZ;
  std::deque<Change> coming_;
};

}  // namespace dsdpv1::cosim
