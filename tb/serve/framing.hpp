#pragma once
// From the bytes that a host writes to telegrams. An operating system hands over a telegram in one piece or in several,
// and a pause between two pieces would be a gap on the line (S10: more than 1 bit time is refused), so a telegram is
// held back until its length, known from the start delimiter and LE, has come.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>

#include "bus/bytes.hpp"
#include "tb/serve/byte_queue.hpp"

namespace dsdpv1::tb::serve {

using WallClock = std::chrono::steady_clock;
using WallTime = WallClock::time_point;

/// 68 LE LEr 68, 249 bytes, FCS, ED.
constexpr std::size_t kLongestTelegram = 255;

/// What the first bytes say about the telegram that they begin.
struct Frame {
  bool telegram = true;    ///< false: no telegram begins like this
  std::size_t length = 0;  ///< bytes of the whole telegram, 0 when more bytes are needed to know
};
Frame frame_of(const std::uint8_t* bytes, std::size_t count);

class Intake {
 public:
  /// A telegram whose rest does not come for so long is handed over as it is: longer than the latency of USB adapters
  /// (16 ms).
  static constexpr std::chrono::milliseconds kPatience{50};
  /// One that comes in ever so small pieces, as a whole: three times what the longest takes at 9.6 kbit/s.
  static constexpr std::chrono::milliseconds kMostPatience{1000};

  /// The host has written `bytes`.
  void take(const bus::Bytes& bytes, WallTime now);
  /// The next telegram that is complete, or bytes that are none: those that begin like no telegram, all that there are,
  /// at once; a telegram that broke off, when it is given up. To be called until it returns nothing.
  std::optional<bus::Bytes> next(WallTime now);
  /// A telegram has begun and is not complete.
  bool holding() const { return !bytes_.empty(); }
  /// When a telegram begun is given up. Only while holding.
  WallTime give_up_at() const { return std::min(last_ + kPatience, begun_ + kMostPatience); }
  std::size_t size() const { return bytes_.size(); }
  /// How many bytes the telegram begun still lacks, as far as its header tells; 0 when none has begun.
  std::size_t missing() const;
  /// Nobody wants any more what has come.
  void clear() { bytes_.clear(); }

 private:
  bus::Bytes take_out(std::size_t count);

  ByteQueue bytes_;
  WallTime begun_{}, last_{};  ///< when the first byte came, and the last
};

}  // namespace dsdpv1::tb::serve
