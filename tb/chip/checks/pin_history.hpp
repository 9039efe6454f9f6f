#pragma once
// The last changes of each pin, to show the cause of a violation.
#include <array>
#include <cstddef>
#include <vector>

#include "bus/time.hpp"
#include "tb/chip/pins/pins.hpp"

namespace dsdpv1::checks {

struct PinChange {
  bus::Tick at = 0;
  const tb::PinInfo* pin = nullptr;  ///< in the chip's table
  tb::Level level = 0;
};

/// Keeps kDepth changes per pin, so that a busy strobe does not displace the handshake.
class PinHistory {
 public:
  static constexpr std::size_t kDepth = 4;

  /// `pins` must outlive it and the results.
  explicit PinHistory(const tb::PinTable& pins) : pins_(pins), rings_(pins.size()) {}

  void add(bus::Tick at, tb::PinNumber pin, tb::Level level) {
    Ring& ring = rings_.at(pin);
    ring.changes.at(ring.count++ % kDepth) = {at, &pins_[pin], level};
    now_ = at;
  }
  /// The tick of the last change of any pin.
  bus::Tick now() const { return now_; }
  /// The kept changes of the pins in `pins`, in order of time.
  std::vector<PinChange> last(tb::PinMask pins) const;

 private:
  struct Ring {
    std::array<PinChange, kDepth> changes{};
    std::size_t count = 0;
  };
  const tb::PinTable& pins_;
  std::vector<Ring> rings_;
  bus::Tick now_ = 0;
};

}  // namespace dsdpv1::checks
