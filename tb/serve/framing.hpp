#pragma once
// From the bytes that a host writes to telegrams. An operating system hands over a telegram in one piece or in several, and a
// pause between two pieces would be a gap on the line (S10: more than 1 bit time is refused), so a telegram is held back until
// its length, known from the start delimiter and LE, has come.
#include <chrono>
#include <cstddef>
#include <optional>

#include "bus/bytes.hpp"

namespace tb::serve {

using WallClock = std::chrono::steady_clock;
using WallTime = WallClock::time_point;

/// What the first bytes say about the telegram that they begin.
struct Frame {
  bool telegram = true;    ///< false: no telegram begins like this
  std::size_t length = 0;  ///< bytes of the whole telegram, 0 when more bytes are needed to know
};
Frame frame_of(const bus::Bytes& bytes);

class Intake {
 public:
  /// A telegram whose rest does not come for so long is handed over as it is: longer than the latency of USB adapters (16 ms).
  static constexpr std::chrono::milliseconds kPatience{50};

  /// The host has written `bytes`.
  void take(const bus::Bytes& bytes, WallTime now);
  /// The next telegram that is complete, or bytes that are none: those that begin like no telegram, all that there are, at once;
  /// a telegram that broke off, after kPatience. To be called until it returns nothing.
  std::optional<bus::Bytes> next(WallTime now);
  /// A telegram has begun and is not complete.
  bool holding() const { return !bytes_.empty(); }
  /// When a telegram begun is given up. Only while holding.
  WallTime give_up_at() const { return last_ + kPatience; }

 private:
  bus::Bytes take_out(std::size_t count);

  bus::Bytes bytes_;
  WallTime last_{};
};

}  // namespace tb::serve
