#pragma once
// Settings of a DSDPV1-RSU needed to read SPI and UART: its straps (R11) and parameters (docs/chip_rsu.md).
#include <array>
#include <cstdint>

#include "bus/time.hpp"
#include "model/dsdpv1/config.hpp"

namespace dsdpv1::tb {

struct SerialSettings {
  Level mode = 0;      ///< MODE: 1 SPI, 2 UART, else parallel
  Level address = 0;   ///< ADR; 1 or 2, else no telegram is for this card
  Level rate = 0;      ///< UBR (UA1)
  Level interval = 0;  ///< UIV (UA3)
  // the chip's parameters, with its defaults and units
  std::uint32_t spi_write_gap = dsdpv1::Config{}.spi_write_gap;
  std::uint32_t spi_reply_gap = dsdpv1::Config{}.spi_reply_gap;
  std::uint32_t spi_miso_delay = dsdpv1::Config{}.spi_miso_delay;
  std::array<std::uint32_t, 8> uart_gaps = dsdpv1::Config{}.uart_gaps;
  std::uint32_t uart_min_tsdr = dsdpv1::Config{}.uart_min_tsdr;

  /// Whether a telegram's `card` number is this card's.
  bool is_own(unsigned card) const { return (card == 1 || card == 2) && card == static_cast<unsigned>(address); }
  /// A bit of the UART, in cycles of CLK.
  bus::Tick bit() const { return kUbrCycles.at(static_cast<std::size_t>(rate & 7)); }
  /// The longest silence within a telegram in half characters (UA3): from B019, or from UIV if B019 holds none of its
  /// codes.
  bus::Tick silence(unsigned b019) const {
    constexpr unsigned kFirstCode = 1, kLastCode = 7;
    const bool by_cell = b019 >= kFirstCode && b019 <= kLastCode;
    return uart_gaps.at(by_cell ? b019 : static_cast<unsigned>(interval & 7));
  }
};

}  // namespace dsdpv1::tb
