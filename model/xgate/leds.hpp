#pragma once
// The four light pins (2.3, command 15, X26): off, on, blinking, or as the module's own states.
#include <array>

#include "model/xgate/config.hpp"

namespace dsdpv1::xgate {

/// In the order of command 15; the pins LED1B, LED1A, LED2A, LED2B.
enum class Led : std::uint8_t { kNetworkGreen, kNetworkRed, kModuleGreen, kModuleRed };
constexpr int kLeds = 4;

/// A LED in self-control.
struct Shown {
  bool on = false, blinks = false;
};
using ShownLeds = std::array<Shown, kLeds>;

class Leds {
 public:
  void reset() { *this = Leds(); }
  void set(std::uint8_t modes, std::uint8_t rates) {
    modes_ = modes;
    rates_ = rates;
  }
  /// The pin's level at a cycle.
  bool level(Led led, const ShownLeds& self, Cycle now) const;
  /// The next cycle after `now` at which a blinking LED changes.
  Cycle next(const ShownLeds& self, Cycle now) const;

  template <class Archive>
  void store(Archive& archive) {
    auto& [modes, rates] = *this;
    archive(modes, rates);
  }

 private:
  Cycle half_period(int led, const ShownLeds& self) const;
  unsigned mode(int led) const { return modes_ >> (2 * led) & 3U; }

  std::uint8_t modes_ = 0xFF, rates_ = 0;
};

}  // namespace dsdpv1::xgate
