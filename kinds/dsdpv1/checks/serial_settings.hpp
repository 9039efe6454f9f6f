#pragma once
// What the checks of SPI and UART have to know of a DSDPV1-RSU: its straps (R11) and parameters (docs/chip_rsu.md).
#include <array>
#include <cstdint>

#include "bus/time.hpp"
#include "model/dsdpv1/config.hpp"

namespace dsdpv1::checks {

using bus::Tick;

constexpr Tick kTicksPerCycle = 250;  ///< of CLK (R2)

struct SerialSettings {
  Level mode = 0;      ///< MODE: 1 SPI, 2 UART, else parallel
  Level address = 0;   ///< ADR; 1 or 2, else no telegram is for this card
  Level rate = 0;      ///< UBR (UA1)
  Level interval = 0;  ///< UIV (UA3)
  // those of the chip, with its defaults and units
  std::uint32_t spi_write_gap = dsdpv1::Config{}.spi_write_gap;
  std::uint32_t spi_reply_gap = dsdpv1::Config{}.spi_reply_gap;
  std::uint32_t spi_miso_delay = dsdpv1::Config{}.spi_miso_delay;
  std::array<std::uint32_t, 8> uart_gaps = dsdpv1::Config{}.uart_gaps;
  std::uint32_t uart_min_tsdr = dsdpv1::Config{}.uart_min_tsdr;
};

}  // namespace dsdpv1::checks
