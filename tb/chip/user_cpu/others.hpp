#pragma once
#include "bus/time.hpp"

namespace dsdpv1::user_cpu {

using bus::Tick;

/// All other agents of the bench, for queries by a user CPU in its turn.
class Others {
 public:
  virtual ~Others() = default;
  /// None of them has a turn before this tick: until then nothing reaches this CPU.
  virtual Tick quiet_until() = 0;
  /// Returns true if that is after `tick`, and the CPU's action there is part of this turn. False: wait for the turn
  /// there.
  virtual bool go_on(Tick tick) = 0;
};

}  // namespace dsdpv1::user_cpu
