#include "tb/checks/pin_history.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace checks {

std::string level_text(dsdpv1::Pin pin, dsdpv1::Level level) {
  if (level == dsdpv1::kLevelZ) return "z";
  if (level == dsdpv1::kLevelX) return "x";
  const int wires = dsdpv1::width(pin);
  return wires == 1 ? fmt::format("{}", level) : fmt::format("{:0{}X}", level, (wires + 3) / 4);
}

std::vector<PinChange> PinHistory::last(std::uint32_t pins) const {
  std::vector<PinChange> all;
  for (int pin = 0; pin < dsdpv1::kPinCount; ++pin) {
    const Ring& ring = rings_.at(static_cast<std::size_t>(pin));
    if ((pins & dsdpv1::mask(static_cast<dsdpv1::Pin>(pin))) == 0) continue;
    for (std::size_t i = ring.count < kDepth ? 0 : ring.count - kDepth; i < ring.count; ++i)
      all.push_back(ring.changes.at(i % kDepth));
  }
  std::stable_sort(all.begin(), all.end(), [](const PinChange& a, const PinChange& b) { return a.at < b.at; });
  return all;
}

}  // namespace checks
