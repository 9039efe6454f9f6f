#pragma once
// INTR0 (5.2, table 16, ruling P7): low pulses of fixed length with a minimum gap.
#include <algorithm>

#include "model/profibus/time.hpp"

namespace dsdpv1 {

using profibus::Cycle;

class Interrupt {
 public:
  Interrupt(Cycle low, Cycle gap) : low_(low), gap_(gap) {}

  void reset() {
    fall_ = rise_ = profibus::kNever;
    ready_ = 0;
  }
  /// New parameter or configuration data in the DPRAM: their flag was written at `now`.
  void trigger(Cycle now) {
    if (fall_ == profibus::kNever) fall_ = std::max(now + 1, ready_);
  }
  void eval(Cycle now) {
    if (now == rise_) rise_ = profibus::kNever;
    if (now != fall_) return;
    fall_ = profibus::kNever;
    rise_ = now + low_;
    ready_ = rise_ + gap_;
  }
  Cycle next() const { return std::min(fall_, rise_); }
  bool level() const { return rise_ == profibus::kNever; }

  template <class Archive>
  void store(Archive& archive) {
    auto& [low, gap, fall, rise, ready] = *this;
    archive.given(low, gap);
    archive.cycles(fall, rise, ready);
  }

 private:
  Cycle low_, gap_;
  Cycle fall_ = profibus::kNever, rise_ = profibus::kNever;
  Cycle ready_ = 0;  // the earliest next fall of INTR0
};

}  // namespace dsdpv1
