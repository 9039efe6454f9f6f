#pragma once
// The serial ports by which a chip's user reaches it: kinds that have one, and a receiver of its UART.
#include <cstdint>
#include <vector>

#include "kinds/user_cpu/uart_receiver.hpp"
#include "tb/chip/pin_device.hpp"

struct dpsim_chip;

namespace dsdpv1::capi {

using bus::Tick;

/// The user's UART: it hears TXD at all times, through everything that advances the chip.
class UserUart {
 public:
  UserUart(tb::PinNumber txd, const UartTiming& timing) : txd_(txd), timing_(timing), receiver_(timing) {}

  tb::PinNumber txd() const { return txd_; }
  const UartTiming& timing() const { return timing_; }
  /// Both directions, from now on; a character in progress is lost.
  void set_rate(const UartTiming& timing, Tick now);
  void txd_changed(Tick at, bool level);
  /// The chip has been replaced by another: characters are received from the next start bit after an idle line on.
  void restart(Tick now);
  /// Moves received characters to `bytes`, at most up to `capacity` of them.
  void take(Tick now, std::vector<std::uint8_t>& bytes, std::size_t capacity);
  /// A tick up to which no character ends, after `now`: time may pass up to then before take().
  Tick quiet_until(Tick now);

 private:
  Tick character() const { return half_bits(timing_, 2 * static_cast<std::int64_t>(timing_.bits())); }

  tb::PinNumber txd_;
  UartTiming timing_;
  user_cpu::UartReceiver receiver_;
  bool idle_ = true;     ///< a start bit may come
  Tick high_since_ = 0;  ///< while not idle_
};

}  // namespace dsdpv1::capi
