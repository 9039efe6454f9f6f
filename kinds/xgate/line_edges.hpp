#pragma once
// The edges of RXD against the module's rate: how far they are from their places in a byte, and the stop bit (4.7.2).
#include <algorithm>
#include <optional>

#include "bus/time.hpp"
#include "model/dsdpv1/serial_host.hpp"

namespace dsdpv1::xgate_checks {

using bus::Tick;

class LineEdges {
 public:
  struct Byte {
    Tick begin = 0;
    Tick off = 0;  ///< greatest distance of an edge
    bool stop_ok = false;
  };

  explicit LineEdges(const UartTiming& timing) : timing_(timing) {}

  void set_timing(const UartTiming& timing) { timing_ = timing; }
  Tick bit() const { return half_bits(timing_, 2); }
  void restart() { begin_.reset(); }
  bool in_byte() const { return begin_.has_value(); }
  /// Time advances to `at`: a byte of which the middle of the stop bit has passed.
  std::optional<Byte> pass(Tick at) {
    if (!begin_ || at <= *begin_ + half_bits(timing_, kMiddleOfStop)) return std::nullopt;
    const Byte byte{*begin_, off_, level_};
    begin_.reset();
    return byte;
  }
  /// After pass() to the same tick.
  void change(Tick at, bool level) {
    level_ = level;
    if (begin_) {
      const Tick within = (at - *begin_) % bit();
      off_ = std::max(off_, std::min(within, bit() - within));
    } else if (!level) {
      begin_ = at;
      off_ = 0;
    }
  }

 private:
  static constexpr int kMiddleOfStop = 19;  // half bits

  UartTiming timing_;
  bool level_ = true;
  std::optional<Tick> begin_;
  Tick off_ = 0;
};

}  // namespace dsdpv1::xgate_checks
