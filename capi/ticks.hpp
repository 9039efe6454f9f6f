#pragma once
// Ticks of the header and of the library, which has them signed.
#include "bus/time.hpp"
#include "capi/error.hpp"

namespace capi {

using bus::Tick;

[[noreturn]] inline void refuse_tick(std::uint64_t tick) {
  fail(DPSIM_ERR_ARGUMENT, "tick is " + std::to_string(tick) + ", allowed are 0 to " + std::to_string(DPSIM_LAST_TICK));
}
inline Tick tick_in(std::uint64_t tick) {
  if (tick > DPSIM_LAST_TICK) refuse_tick(tick);
  return static_cast<Tick>(tick);
}
[[noreturn]] inline void refuse_past(std::uint64_t tick, Tick now) {
  fail(DPSIM_ERR_TIME, "tick is " + std::to_string(tick) + ", which is before the present tick " + std::to_string(now));
}
/// One that is not before `now`.
inline Tick tick_from(std::uint64_t tick, Tick now) {
  const Tick at = tick_in(tick);
  if (at < now) refuse_past(tick, now);
  return at;
}
inline std::uint64_t tick_out(Tick tick) {
  return tick > static_cast<Tick>(DPSIM_LAST_TICK) ? DPSIM_NEVER : static_cast<std::uint64_t>(tick);
}

}  // namespace capi
