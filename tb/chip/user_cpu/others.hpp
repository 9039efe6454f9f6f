#pragma once
#include "bus/time.hpp"

namespace dsdpv1::user_cpu {

using bus::Tick;

/// Everybody else on the bench, as a user CPU may ask about them in its turn.
class Others {
 public:
  virtual ~Others() = default;
  /// None of them has a turn before this tick: until then nothing reaches this CPU.
  virtual Tick quiet_until() = 0;
  /// That is behind `tick`, and what this CPU does there is part of this turn. False: it is to wait for its turn there.
  virtual bool go_on(Tick tick) = 0;
};

}  // namespace dsdpv1::user_cpu
