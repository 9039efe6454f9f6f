#pragma once
// The serial ports of a DSDPV1-RSU, as a user CPU has them: its pins, and the controllers at them.
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
  /// XSS, SCK, MOSI, RXD. Calls come in order of time. A chip without them: nothing.
  virtual void set_serial(Tick /*at*/, dsdpv1::Pin /*pin*/, bool /*level*/) {}
  /// MISO as it is strictly before what is set at `at`; true where nobody drives it.
  virtual bool miso(Tick /*at*/) { return true; }
  /// Told of each change of TXD, in order of time, not later than anybody acts at that tick.
  std::function<void(Tick at, bool level)> on_txd;

  /// The CPU's controllers: on these pins, each edge in its turn, unless whoever has a socket knows better.
  virtual std::unique_ptr<SpiMaster> make_spi_master(const SpiTiming& timing);
  virtual std::unique_ptr<UartSender> make_uart_sender(const UartTiming& timing);
};

}  // namespace dsdpv1::user_cpu
