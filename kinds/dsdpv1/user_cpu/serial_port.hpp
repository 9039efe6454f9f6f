#pragma once
// The driver's SPI and UART ports on a simulated CPU, which a device maker writes for their MCU; with counters and
// optional faults.
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "driver/dsdpv1_spi.h"
#include "driver/dsdpv1_uart.h"
#include "kinds/dsdpv1/user_cpu/uart_master.hpp"
#include "kinds/user_cpu/claim_counters.hpp"
#include "kinds/user_cpu/cpu.hpp"
#include "kinds/user_cpu/spi_master.hpp"
#include "tb/chip/user_cpu/program.hpp"

namespace dsdpv1::user_cpu {

/// The user's end of an SPI port.
struct SpiPort {
  SpiTiming timing;
  std::uint8_t spare = 0;  ///< dsdpv1_spi::spare
};

/// The user's end of a UART port.
struct UartPort {
  UartTiming timing;
  std::uint16_t interval = 0, tsdr = 0;  ///< dsdpv1_uart's
};

/// The port through which a program reaches the chip.
struct HostPort {
  std::variant<std::monostate, SpiPort, UartPort> port;  ///< std::monostate: the parallel one
  std::uint8_t address = 1;                              ///< ADR of the chip
  bool block_crc = false;                                ///< dsdpv1_spi's and dsdpv1_uart's
};

enum class TelegramFault : std::uint8_t { kFlippedBit, kCut, kWrongParity, kBreak, kPause, kTalkOver };

/// Must not move while the driver uses it.
class SerialPort {
 public:
  /// `cpu` must outlive it.
  SerialPort(Cpu& cpu, const HostPort& port);
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;
  ~SerialPort();

  dsdpv1_error open(dsdpv1_device& device, const dsdpv1_judge& judge);
  /// SPI: from the claim's frame to the release's; UART: none are counted.
  const HoldCounters& counters() const { return claims_.counters(); }
  /// Disturbs the CPU's next `times` telegrams. `pause`: for TelegramFault::kPause.
  void spoil(TelegramFault fault, int times, Tick pause);
  /// Sends any bytes and their CRC; see `listen` of a scenario's host_telegram.
  void telegram(std::vector<std::uint8_t> bytes, std::optional<int> listen);
  // The functions of dsdpv1_spi and dsdpv1_uart.
  bool frame(const std::uint8_t* out, std::uint8_t* in, std::size_t n);
  bool send(const std::uint8_t* bytes, std::size_t n);
  std::uint16_t receive(std::uint8_t* bytes, std::size_t n, std::uint32_t timeout_us);

 private:
  void telegram_over_spi(std::vector<std::uint8_t> bytes, int listen);
  void telegram_over_uart(const std::vector<std::uint8_t>& bytes, std::optional<int> listen);
  void pause(std::uint32_t ns);
  bool is_spoilt(TelegramFault fault);
  UartFault uart_fault();

  Cpu& cpu_;
  SerialPins& pins_;  ///< outlives the CPU
  HostPort port_;
  std::unique_ptr<SpiMaster> spi_master_;    ///< for an SPI port
  std::unique_ptr<UartSender> uart_sender_;  ///< for a UART port
  UartReceiver receiver_{{}};
  dsdpv1_spi spi_{};
  dsdpv1_uart uart_{};
  ClaimCounters claims_;
  TelegramFault fault_ = TelegramFault::kFlippedBit;
  Tick pause_ = 0;
  int spoilt_ = 0;
};

}  // namespace dsdpv1::user_cpu
