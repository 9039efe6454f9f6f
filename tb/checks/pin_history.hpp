#pragma once
// The last changes of each pin, for whoever has to see how a violation came about.
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "bus/time.hpp"
#include "model/dsdpv1/pins.hpp"

namespace checks {

struct PinChange {
  bus::Tick at = 0;
  dsdpv1::Pin pin = dsdpv1::Pin::kReset;
  dsdpv1::Level level = 0;
};

/// "1", "7FF", "z", "x".
std::string level_text(dsdpv1::Pin pin, dsdpv1::Level level);

/// Keeps kDepth changes a pin, so that a busy strobe does not push out the handshake.
class PinHistory {
 public:
  static constexpr std::size_t kDepth = 4;

  void add(bus::Tick at, dsdpv1::Pin pin, dsdpv1::Level level) {
    Ring& ring = rings_.at(static_cast<std::size_t>(pin));
    ring.changes.at(ring.count++ % kDepth) = {at, pin, level};
    now_ = at;
  }
  /// The tick of the last change of any pin.
  bus::Tick now() const { return now_; }
  /// The kept changes of the pins in `pins` (see dsdpv1::mask), in order of time.
  std::vector<PinChange> last(std::uint32_t pins) const;

 private:
  struct Ring {
    std::array<PinChange, kDepth> changes{};
    std::size_t count = 0;
  };
  std::array<Ring, dsdpv1::kPinCount> rings_{};
  bus::Tick now_ = 0;
};

}  // namespace checks
