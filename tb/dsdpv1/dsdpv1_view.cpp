#include "tb/dsdpv1/dsdpv1_view.hpp"

namespace tb {

ChipStatus Dsdpv1View::status() const {
  const dsdpv1::Status own = core().status();
  ChipStatus status = common_status(own);
  status.c2 = own.c2;
  status.accesses = own.accesses;
  status.longest_wait = static_cast<Tick>(own.longest_wait) * profibus::kTicksPerCycle;
  return status;
}

}  // namespace tb
