#include "kinds/dsdpv1/chip/dsdpv1_view.hpp"

#include <fmt/format.h>

namespace dsdpv1::tb {

ChipStatus status_of(const dsdpv1::Chip& core) {
  const dsdpv1::Status own = core.status();
  ChipStatus status = common_status(own);
  status.c2 = own.c2;
  status.accesses = own.accesses;
  status.longest_wait = static_cast<Tick>(own.longest_wait) * profibus::kTicksPerCycle;
  return status;
}

void Dsdpv1View::tell_action(Tick at, const user_cpu::Access& access) const {
  if (!on_action) return;
  on_action(at, access.write ? fmt::format("write B{:03X} {:02X}", access.address, access.value)
                             : fmt::format("read B{:03X}", access.address));
}

void Dsdpv1View::tell_action(Tick at, const char* pin, bool level) const {
  if (on_action) on_action(at, fmt::format("{} {}", pin, level ? 1 : 0));
}

}  // namespace dsdpv1::tb
