#include "kinds/dsdpv1/chip/core_device.hpp"

namespace dsdpv1::tb {

ChipStatus status_of(const dsdpv1::Chip& core) {
  const dsdpv1::Status own = core.status();
  ChipStatus status = common_status(own);
  status.c2 = own.c2;
  status.accesses = own.accesses;
  status.longest_wait = static_cast<Tick>(own.longest_wait) * profibus::kTicksPerCycle;
  return status;
}

void CoreDevice::watch(const PinSink& sink, PinMask pins, bool late) {
  sink_ = sink;
  chip_.watch({[](void* self, Tick at, dsdpv1::Pin pin, Level level) {
                 const PinSink& to = static_cast<CoreDevice*>(self)->sink_;
                 to.call(to.self, at, number(pin), level);
               },
               this},
              sink.call == nullptr ? 0 : pins, late);
}

}  // namespace dsdpv1::tb
