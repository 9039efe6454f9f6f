#pragma once
// Forms telegrams from the bytes that a host writes. An operating system delivers a telegram in one piece or several,
// and a pause between two pieces would be a gap on the line (S10: more than 1 bit time is refused). So a telegram is
// held back until its length, known from the start delimiter and LE, has come.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "bus/bytes.hpp"
#include "tb/serve/byte_queue.hpp"

namespace dsdpv1::tb::serve {

using WallClock = std::chrono::steady_clock;
using WallTime = WallClock::time_point;

/// 68 LE LEr 68, 249 bytes, FCS, ED.
constexpr std::size_t kLongestTelegram = 255;

/// Properties of a telegram derived from its first bytes.
struct Frame {
  bool telegram = true;    ///< false: no telegram begins like this
  std::size_t length = 0;  ///< bytes of the whole telegram, 0 if more bytes are needed to know
};
Frame frame_of(const std::uint8_t* bytes, std::size_t count);

/// Bytes of a serial port whose driver marks errors (termios: PARMRK): FF 00 b is the byte b with wrong parity or stop
/// bit, or the 00 of a break, and FF FF is FF.
class MarkedBytes {
 public:
  struct Byte {
    std::uint8_t value = 0;
    bool wrong = false;
  };
  /// The byte that the next one read completes.
  std::optional<Byte> take(std::uint8_t read);
  void clear() { seen_ = 0; }

 private:
  int seen_ = 0;  ///< bytes of a mark
};

/// A telegram, or bytes that are none.
struct Taken {
  bus::Bytes bytes;
  std::optional<std::size_t> wrong_at = {};  ///< the first with wrong parity or stop bit
};

class Intake {
 public:
  /// A telegram is passed on incomplete if its rest does not come for this long: longer than the latency of USB
  /// adapters (16 ms).
  static constexpr std::chrono::milliseconds kPatience{50};
  /// The limit for a telegram that arrives in small pieces: three times the duration of the longest one at 9.6 kbit/s.
  static constexpr std::chrono::milliseconds kMostPatience{1000};

  /// The host has written `bytes`, those at `wrong`, in order, with errors.
  void take(const bus::Bytes& bytes, WallTime now, const std::vector<std::size_t>& wrong = {});
  /// Returns the next complete telegram, or bytes that are none: those that cannot begin a telegram, all of them at
  /// once; an incomplete telegram, when it is given up. Call it until it returns nothing.
  std::optional<Taken> next(WallTime now);
  /// A telegram has begun and is not complete.
  bool holding() const { return !bytes_.empty(); }
  /// When an incomplete telegram is given up. Only while holding.
  WallTime give_up_at() const { return std::min(last_ + kPatience, begun_ + kMostPatience); }
  std::size_t size() const { return bytes_.size(); }
  /// The number of bytes missing in the present telegram, according to its header; 0 without one.
  std::size_t missing() const;
  /// Drops the bytes received.
  void clear() {
    bytes_.clear();
    wrong_.clear();
  }

 private:
  Taken take_out(std::size_t count);

  ByteQueue bytes_;
  std::deque<std::size_t> wrong_;  ///< places in bytes_
  WallTime begun_{}, last_{};      ///< time of the first byte, and of the last
};

}  // namespace dsdpv1::tb::serve
