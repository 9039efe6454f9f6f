#pragma once
// A host's end of the line to an XGate-DPS10, on the pins of its chip of the bench: bytes by UART or SPI.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "kinds/user_cpu/uart_receiver.hpp"
#include "kinds/xgate/orders.hpp"
#include "kinds/xgate/settings.hpp"
#include "tb/kit/slave_kit.hpp"

namespace dsdpv1::xgate {

/// The module's pin for one of a controller: kXss, kSck, kMosi, kRxd.
kit::PinNumber bench_pin(dsdpv1::Pin pin);

/// Lives on the program's stack. By UART it receives at all times.
class HostLine {
 public:
  /// With the settings of `cpu`, and the port and rate of its chip; `cpu` must outlive it.
  explicit HostLine(kit::Cpu& cpu);
  ~HostLine() { cpu_.on_change(nullptr); }
  HostLine(const HostLine&) = delete;
  HostLine& operator=(const HostLine&) = delete;

  /// Returns when the last byte has left. Orders of the script damage it, or send a frame before it.
  void send(const std::uint8_t* bytes, std::size_t n);
  /// The next byte, nothing if none has come in this time. By SPI the host clocks it; it waits for /INT to begin an
  /// answer.
  std::optional<std::uint8_t> receive(Tick timeout);

 private:
  void take_orders();
  void transmit(std::vector<std::uint8_t> out);
  void send_wrong(std::vector<std::uint8_t> out, const user_cpu::command::OfChip& fault);
  void interpose(const user_cpu::command::OfChip& order);
  std::uint8_t clock(std::vector<std::uint8_t> out, std::optional<std::size_t> bits = {});
  bool wait_for_int(Tick until);

  kit::Cpu& cpu_;
  const UserSettings& own_;
  LineFaults faults_;
  std::vector<std::uint8_t> to_damage_;  ///< the part of a command that has come, if it has a fault
  const bool by_spi_;
  const UartTiming uart_;
  SpiTiming spi_;
  user_cpu::UartReceiver receiver_;
  Tick free_at_ = 0;           ///< SPI: NSS has been high for long enough
  bool answer_begun_ = false;  ///< SPI: since the last send
};

}  // namespace dsdpv1::xgate
