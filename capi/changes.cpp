#include "capi/changes.hpp"

#include "capi/clock.hpp"
#include "capi/error.hpp"

namespace dsdpv1::capi {

void read_changes(Changes& from, dpsim_change* changes, std::size_t capacity, std::size_t* count) {
  need_buffer(changes, capacity, "changes");
  need(count, "count");
  *count = from.take(changes, capacity);
}

void refuse_tick(std::uint64_t tick, Tick now) {
  if (tick > DPSIM_LAST_TICK)
    fail(DPSIM_ERR_ARGUMENT, "tick is " + std::to_string(tick) + ", expected 0 to " + std::to_string(DPSIM_LAST_TICK));
  fail(DPSIM_ERR_TIME, "tick is " + std::to_string(tick) + ", which is before the present tick " + std::to_string(now));
}

void refuse_inside() {
  fail(DPSIM_ERR_STATE, "called inside of a callback of the same object, where it must not be changed");
}

}  // namespace dsdpv1::capi
