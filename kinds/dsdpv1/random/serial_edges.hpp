#pragma once
// A frame of SPI and a telegram of UART as the host's edges at the pins of the DSDPV1-RSU.
#include <vector>

#include "cosim/random/stimulus.hpp"

namespace dsdpv1::cosim {

struct PinEdge {
  Tick at;
  Pin pin;
  Level level;
};

/// Ticks of a bit by UBR's code (UA1), 0 to 7.
Tick uart_bit(int rate);

/// Verb::kSpi from XSS's fall at tick 0 to its rise; in order of time.
std::vector<PinEdge> spi_edges(const Action& action);
/// Verb::kUart from the first start bit at tick 0 to the end of the last bit, where RXD is high again; in order of
/// time.
std::vector<PinEdge> uart_edges(const Action& action);

}  // namespace dsdpv1::cosim
