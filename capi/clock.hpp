#pragma once
// Converts ticks of the header to those of the library, which are signed; an object's time and callback state.
#include <cstdint>
#include <utility>

#include "bus/time.hpp"
#include "dsdpv1/types.h"

namespace dsdpv1::capi {

using bus::Tick;

struct Clock {
  Tick now = 0;          ///< to which the last call advanced the object
  bool calling = false;  ///< inside a callback, where the object must not be run or changed
};

/// Used around each callback of an object.
class Callback {
 public:
  explicit Callback(Clock& clock) : clock_(clock), before_(std::exchange(clock.calling, true)) {}
  ~Callback() { clock_.calling = before_; }
  Callback(const Callback&) = delete;
  Callback& operator=(const Callback&) = delete;

 private:
  Clock& clock_;
  bool before_;
};

[[noreturn]] void refuse_inside();
/// Called at the beginning of each call that runs or changes an object.
inline void need_outside(const Clock& clock) {
  if (clock.calling) refuse_inside();
}

/// Replaces need_outside: everything reported within this call is a callback and needs no Callback.
class Running {
 public:
  explicit Running(Clock& clock) : clock_(clock) {
    need_outside(clock);
    clock.calling = true;
  }
  ~Running() { clock_.calling = false; }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

 private:
  Clock& clock_;
};

[[noreturn]] void refuse_tick(std::uint64_t tick, Tick now);
/// A tick that is not before `now`.
inline Tick tick_from(std::uint64_t tick, Tick now) {
  const auto past = static_cast<std::uint64_t>(now);
  if (tick - past > DPSIM_LAST_TICK - past) refuse_tick(tick, now);  // earlier ticks wrap
  return static_cast<Tick>(tick);
}
inline Tick tick_in(std::uint64_t tick) { return tick_from(tick, 0); }
inline std::uint64_t tick_out(Tick tick) {
  return tick > static_cast<Tick>(DPSIM_LAST_TICK) ? DPSIM_NEVER : static_cast<std::uint64_t>(tick);
}

}  // namespace dsdpv1::capi
