#pragma once
// Telegrams between a chip and its user over a serial host port, derived only from the pins: the same for every engine,
// user CPU and RTL.
#include <functional>
#include <string>

#include "bus/bytes.hpp"
#include "bus/timeline.hpp"
#include "tb/chip/pins/pins.hpp"

namespace dsdpv1::tb {

/// A telegram, complete or not.
struct HostTelegram {
  bus::Tick start = 0, end = 0;
  bool reply = false;  ///< from the chip; else a request of the user
  std::string words;   ///< its kind, address, length, error code, card and CRC
  bus::Bytes bytes;
  std::string wrong;    ///< its fault; empty: none
  bus::Tick known = 0;  ///< when the pins have shown it: its end, or later
};

/// Reads one chip's pins.
class HostReader : public bus::Agent {
 public:
  /// "spi", "uart": the port's name in waves and logs.
  virtual const char* port() const = 0;
  /// Pins that must be reported to it.
  virtual PinMask pins() const = 0;
  /// In order of time; pins that change at the same tick in any order.
  virtual void pin(bus::Tick at, PinNumber pin, Level level) = 0;

  /// Called for each telegram when it has ended, at the latest when that is known.
  std::function<void(const HostTelegram&)> on_telegram;

 protected:
  void tell(HostTelegram telegram) {
    telegram.known = now_;
    on_telegram(telegram);
  }

  bus::Tick now_ = 0;  ///< of the present turn or change
};

}  // namespace dsdpv1::tb
