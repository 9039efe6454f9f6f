#pragma once
#include "bus/time.hpp"

namespace dsdpv1::user_cpu {

using bus::Tick;

/// Everybody else on the bench, as a user CPU may ask about them in its turn.
class Others {
 public:
  virtual ~Others() = default;
  /// None of them has a turn up to and including `tick`: until then nothing reaches this CPU.
  virtual bool quiet(Tick tick) = 0;
  /// The same, and what this CPU does at `tick` is part of this turn. False: it is to wait for its turn there.
  virtual bool go_on(Tick tick) = 0;
};

}  // namespace dsdpv1::user_cpu
