#pragma once
// What the checks of SPI have to know of a DSDPV1-RSU: its straps (R11) and parameters (docs/chip_rsu.md).
#include <cstdint>

#include "model/dsdpv1/pins.hpp"

namespace dsdpv1::checks {

struct SerialSettings {
  Level mode = 0;                     ///< MODE: 1 SPI, 2 UART, else parallel
  Level address = 0;                  ///< ADR; 1 or 2, else no telegram is for this card
  std::uint32_t spi_write_gap = 128;  ///< cycles
};

}  // namespace dsdpv1::checks
