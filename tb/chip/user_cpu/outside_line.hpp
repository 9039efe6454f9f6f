#pragma once
// A program outside of the simulation as the user of a chip with a serial line: the bytes between them, without times.
#include <cstddef>
#include <deque>
#include <functional>

#include "bus/bytes.hpp"
#include "bus/time.hpp"

namespace dsdpv1::user_cpu {

struct OutsideLine {
  static constexpr std::size_t kMostWaiting = 2048;

  std::deque<std::uint8_t> to_chip;  ///< the program has sent them; at most kMostWaiting
  bus::Bytes from_chip;              ///< for the program
  /// Set by the chip's user CPU, called after bytes have been added to `to_chip`; `now` is simulated time, between two
  /// turns. Null while the chip is in reset: what comes then is lost.
  std::function<void(bus::Tick now)> on_bytes;
};

}  // namespace dsdpv1::user_cpu
