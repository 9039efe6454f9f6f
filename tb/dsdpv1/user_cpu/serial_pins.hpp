#pragma once
// The pins of a DSDPV1-RSU's serial ports, as a user CPU has them.
#include <cstdint>
#include <functional>

#include "bus/time.hpp"

namespace dsdpv1::user_cpu {

using bus::Tick;

enum class SerialPin : std::uint8_t { kXss, kSck, kMosi, kMiso, kRxd, kTxd };

class SerialPins {
 public:
  virtual ~SerialPins() = default;
  /// XSS, SCK, MOSI, RXD. Calls come in order of time. A chip without them: nothing.
  virtual void set_serial(Tick /*at*/, SerialPin /*pin*/, bool /*level*/) {}
  /// MISO as it is strictly before what is set at `at`; true where nobody drives it.
  virtual bool miso(Tick /*at*/) { return true; }
  /// Told of each change of TXD, in order of time, not later than anybody acts at that tick.
  std::function<void(Tick at, bool level)> on_txd;
};

}  // namespace dsdpv1::user_cpu
