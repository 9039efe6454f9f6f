#pragma once
// The telegrams of a DSDPV1-RSU on the memory of a FakeChip: docs/chip_rsu.md for SPI (SP4 to SP16) and UART (UA5 to
// UA13), without time. The chip makes its access when the host releases (SPI), after each telegram (UART). It checks
// the host's discipline: no cell without the claim.
#include <deque>

#include "driver/dsdpv1_spi.h"
#include "driver/dsdpv1_uart.h"
#include "tests/driver/fake_chip.hpp"

namespace dsdpv1 {

enum class FakePort { kParallel, kSpi, kUart };

class FakeRsu {
 public:
  using Bytes = std::vector<std::uint8_t>;

  explicit FakeRsu(FakeChip& chip) : chip_(chip) {}

  /// Opens `device` on that port of the chip, whose address is 1.
  dsdpv1_error open(FakePort kind, dsdpv1_device& device, const dsdpv1_judge& judge);

  // -------------------------------------------------------------------------------------------------------- behaviour
  int busy_claims = 0;      ///< number of claims that come during an access of the chip (SP13)
  int failing_calls = 0;    ///< number of failing calls of the host's functions
  int deaf = 0;             ///< number of telegrams that are ignored
  int spoilt_requests = 0;  ///< number of telegrams that arrive with a wrong byte
  int spoilt_replies = 0;   ///< number of replies with a wrong byte
  int reply_gap = 0;        ///< SP6, bytes
  bool data_exchange = true;
  std::function<void(const Bytes& request)> before_telegram;  ///< the chip's actions between two telegrams

  // ------------------------------------------------------------------------------------ the lines, a byte at a time
  void select() { frame_.clear(), reply_.clear(); }
  std::uint8_t spi_byte(std::uint8_t out);
  void uart_character(std::uint8_t character);
  bool next_character(std::uint8_t& character);

  // ---------------------------------------------------------------------------------------------------- what it saw
  std::vector<Bytes> requests, replies;
  std::size_t bytes = 0;     ///< on the wire, both ways; SPI: byte slots of the frames
  std::size_t silences = 0;  ///< UART: calls of `receive` that ended without a character
  std::uint32_t longest_timeout_us = 0;
  dsdpv1_spi spi{};
  dsdpv1_uart uart{};

 private:
  bool frame(const std::uint8_t* out, std::uint8_t* in, std::uint16_t n);
  std::uint16_t receive(std::uint8_t* to, std::uint16_t n, std::uint32_t timeout_us);

  Bytes answer(FakePort port, Bytes request);
  Bytes carry_out(FakePort port, const Bytes& request);
  Bytes read(std::uint16_t address, std::size_t length);
  Bytes write(FakePort port, std::uint16_t address, const Bytes& data);
  Bytes read_and_write(const Bytes& data);
  Bytes exchange(const Bytes& request);
  Bytes news(bool inputs);
  void claim(const char* what);

  FakeChip& chip_;
  std::uint8_t ownership_ = 0;  ///< B014.1
  Bytes frame_, reply_;         ///< SPI: bytes received since XSS fell, bytes to send
  Bytes telegram_;              ///< UART: bytes received so far
  std::deque<std::uint8_t> line_;
};

}  // namespace dsdpv1
