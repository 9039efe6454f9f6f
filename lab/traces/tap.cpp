#include "lab/traces/tap.hpp"

#include <algorithm>

namespace dsdpv1::tb::traces {

SignalNumbers::SignalNumbers(const scenario::Scenario& scenario) : first_{0} {
  for (const scenario::Slave& slave : scenario.slaves) first_.push_back(first_.back() + slave.kind->pins().size());
}

std::size_t SignalNumbers::slave(std::size_t signal) const {
  return static_cast<std::size_t>(std::upper_bound(first_.begin(), first_.end(), signal) - first_.begin()) - 1;
}

Tap::Tap(const scenario::Scenario& scenario, bus::Segment& segment) : segment_(segment), numbers_(scenario) {
  segment.attach("trace", this);
}

void Tap::begins(std::size_t slave, const ChipView& chip) {
  if (slave == 0) tell(numbers_.line(), 0, segment_.level() ? 1 : 0);
  for (std::size_t i = 0; i < numbers_.pins(slave); ++i) {
    const auto number = static_cast<PinNumber>(i);
    pin(slave, 0, number, chip.level(number));
  }
}

}  // namespace dsdpv1::tb::traces
