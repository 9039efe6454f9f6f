#include "model/xgate/leds.hpp"

#include <algorithm>

namespace dsdpv1::xgate {
namespace {

constexpr unsigned kOn = 1, kBlinks = 2, kSelf = 3;
constexpr Cycle kSelfHalf = 250 * profibus::kCyclesPerMs;
constexpr Cycle kHalf[] = {0, 1000 * profibus::kCyclesPerMs, 500 * profibus::kCyclesPerMs,
                           250 * profibus::kCyclesPerMs};  // 0, 0.5, 1, 2 Hz

}  // namespace

/// Half a period of a LED that blinks; 0: it does not.
Cycle Leds::half_period(int led, const ShownLeds& self) const {
  const Shown& shown = self[static_cast<std::size_t>(led)];
  if (mode(led) == kSelf) return shown.on && shown.blinks ? kSelfHalf : 0;
  return mode(led) == kBlinks ? kHalf[rates_ >> (2 * led) & 3U] : 0;
}

bool Leds::level(Led led, const ShownLeds& self, Cycle now) const {
  const int place = static_cast<int>(led);
  if (const Cycle half = half_period(place, self); half != 0) return now / half % 2 == 0;
  return mode(place) == kOn || (mode(place) == kSelf && self[static_cast<std::size_t>(place)].on);
}

Cycle Leds::next(const ShownLeds& self, Cycle now) const {
  Cycle first = profibus::kNever;
  for (int led = 0; led < kLeds; ++led)
    if (const Cycle half = half_period(led, self); half != 0) first = std::min(first, (now / half + 1) * half);
  return first;
}

}  // namespace dsdpv1::xgate
