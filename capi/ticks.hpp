#pragma once
// Ticks of the header and of the library, which has them signed.
#include "bus/time.hpp"
#include "capi/error.hpp"

namespace capi {

using bus::Tick;

inline Tick tick_in(std::uint64_t tick) {
  if (tick > DPSIM_LAST_TICK)
    fail(DPSIM_ERR_ARGUMENT,
         "tick is " + std::to_string(tick) + ", allowed are 0 to " + std::to_string(DPSIM_LAST_TICK));
  return static_cast<Tick>(tick);
}
/// One that is not before `now`.
inline Tick tick_from(std::uint64_t tick, Tick now) {
  const Tick at = tick_in(tick);
  if (at < now)
    fail(DPSIM_ERR_TIME,
         "tick is " + std::to_string(tick) + ", which is before the present tick " + std::to_string(now));
  return at;
}
inline std::uint64_t tick_out(Tick tick) {
  return tick > static_cast<Tick>(DPSIM_LAST_TICK) ? DPSIM_NEVER : static_cast<std::uint64_t>(tick);
}

}  // namespace capi
