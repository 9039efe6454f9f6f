#include "capi/changes.hpp"

#include "capi/error.hpp"

namespace capi {

void read_changes(Changes& from, dpsim_change* changes, std::size_t capacity, std::size_t* count) {
  need_buffer(changes, capacity, "changes");
  need(count, "count");
  *count = from.take(changes, capacity);
}

void Turn::refuse() {
  fail(DPSIM_ERR_STATE, "called inside of a callback of the same object, where it must not be changed");
}

}  // namespace capi
