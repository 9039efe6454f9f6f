#pragma once
// Something on a serial port that takes its time, edge by edge, while the program that began it waits.
#include "bus/time.hpp"

namespace dsdpv1::user_cpu {

using bus::Tick;

class Transfer {
 public:
  virtual ~Transfer() = default;
  /// The tick of its next action, `bus::kNever` when there is none; may move while it waits for the chip.
  virtual Tick next() const = 0;
  /// Acts at `now`, which is `next()`.
  virtual void run(Tick now) = 0;
  /// It is over, since its last action.
  virtual bool done() const = 0;
};

}  // namespace dsdpv1::user_cpu
