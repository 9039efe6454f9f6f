#pragma once
// Telegrams between a chip and its user over a serial host port, read from the pins alone: the same for every engine,
// user CPU and RTL.
#include <functional>
#include <string>

#include "bus/bytes.hpp"
#include "bus/timeline.hpp"
#include "tb/chip/pins/pins.hpp"

namespace dsdpv1::tb {

/// A telegram, or what was to be one.
struct HostTelegram {
  bus::Tick start = 0, end = 0;
  bool reply = false;  ///< of the chip; else a request of the user
  std::string words;   ///< its kind, address, length, error code, card and CRC
  bus::Bytes bytes;
  std::string wrong;    ///< what is wrong with it; empty: nothing
  bus::Tick known = 0;  ///< when the pins have said so: its end, or later
};

/// Reads one chip's pins.
class HostReader : public bus::Agent {
 public:
  /// "spi", "uart": what waves and logs call the port.
  virtual const char* port() const = 0;
  /// Pins that it has to be told of.
  virtual PinMask pins() const = 0;
  /// In order of time; pins that change at the same tick in any order.
  virtual void pin(bus::Tick at, PinNumber pin, Level level) = 0;

  /// Each telegram when it has ended, at the latest when it is known that it has.
  std::function<void(const HostTelegram&)> on_telegram;

 protected:
  void tell(HostTelegram telegram) {
    telegram.known = now_;
    on_telegram(telegram);
  }

  bus::Tick now_ = 0;  ///< of the turn or the change under way
};

}  // namespace dsdpv1::tb
