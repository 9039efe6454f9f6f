#pragma once
// An operation on a serial port that proceeds edge by edge, while the program that began it waits.
#include "bus/time.hpp"

namespace dsdpv1::user_cpu {

using bus::Tick;

class Transfer {
 public:
  virtual ~Transfer() = default;
  /// The tick of its next action, `bus::kNever` without one; may change while it waits for the chip.
  virtual Tick next() const = 0;
  /// Acts at `now`, which is `next()`.
  virtual void run(Tick now) = 0;
  /// True after its last action.
  virtual bool done() const = 0;
};

}  // namespace dsdpv1::user_cpu
