#include "tb/chip/checks/pin_history.hpp"

#include <algorithm>

namespace dsdpv1::checks {

std::vector<PinChange> PinHistory::last(tb::PinMask pins) const {
  std::vector<PinChange> all;
  for (std::size_t pin = 0; pin < rings_.size(); ++pin) {
    const Ring& ring = rings_[pin];
    if ((pins & tb::mask_of(static_cast<tb::PinNumber>(pin))) == 0) continue;
    for (std::size_t i = ring.count < kDepth ? 0 : ring.count - kDepth; i < ring.count; ++i)
      all.push_back(ring.changes.at(i % kDepth));
  }
  std::stable_sort(all.begin(), all.end(), [](const PinChange& a, const PinChange& b) { return a.at < b.at; });
  return all;
}

}  // namespace dsdpv1::checks
