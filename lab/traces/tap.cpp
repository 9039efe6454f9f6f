#include "lab/traces/tap.hpp"

namespace dsdpv1::tb::traces {

Tap::Tap(const scenario::Scenario& scenario, bus::Segment& segment)
    : segment_(segment), pins_(scenario.kind->pins().size()), line_(scenario.slaves.size() * pins_) {
  segment.attach("trace", this);
}

void Tap::begins(std::size_t slave, const ChipView& chip) {
  if (slave == 0) tell(line_, 0, segment_.level() ? 1 : 0);
  for (std::size_t i = 0; i < pins_; ++i) {
    const auto number = static_cast<PinNumber>(i);
    pin(slave, 0, number, chip.level(number));
  }
}

}  // namespace dsdpv1::tb::traces
