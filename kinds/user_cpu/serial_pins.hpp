#pragma once
// The serial ports of a DSDPV1-RSU for a user CPU: its pins, and the controllers on them.
#include <functional>
#include <memory>

#include "bus/time.hpp"
#include "model/dsdpv1/serial_host.hpp"
#include "tb/chip/user_cpu/user_side.hpp"

namespace dsdpv1::user_cpu {

using bus::Tick;

class SpiMaster;
class UartSender;

class SerialPins : public UserSide {
 public:
  /// Sets XSS, SCK, MOSI, RXD. Calls come in order of time. Does nothing for a chip without them.
  virtual void set_serial(Tick /*at*/, dsdpv1::Pin /*pin*/, bool /*level*/) {}
  /// MISO strictly before a change set at `at`; true while it is not driven.
  virtual bool miso(Tick /*at*/) { return true; }
  /// Called at each change of TXD, in order of time, before any agent acts at that tick.
  std::function<void(Tick at, bool level)> on_txd;

  /// The CPU's controllers: on these pins, with one turn per edge, unless an adapter to a socket overrides it.
  virtual std::unique_ptr<SpiMaster> make_spi_master(const SpiTiming& timing);
  virtual std::unique_ptr<UartSender> make_uart_sender(const UartTiming& timing);
};

}  // namespace dsdpv1::user_cpu
