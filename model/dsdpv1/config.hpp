#pragma once
// A chip's configuration at construction: the part, and the parameters of the rulings marked (p).
#include <array>
#include <cstdint>

#include "model/dsdpv1/pins.hpp"

namespace dsdpv1 {

enum class Engine : std::uint8_t {
  kStep,  ///< every cycle of every block is evaluated
  kSkip,  ///< jumps to the next cycle with an event; the same pin trace
};

/// The live host port, in the coding of MODE (R11).
enum class HostMode : std::uint8_t { kParallel, kSpi, kUart };

/// UA1: cycles per bit of the UART, by the strap UBR.
constexpr std::array<int, 8> kUbrCycles = {5000, 2500, 1250, 833, 417, 208, 104, 26};

/// The parameters of the rulings marked (p), with their defaults; parameters.inc has meaning, unit and range.
struct Config {
  Engine engine = Engine::kSkip;
  Part part = Part::kDsdpv1;
#define DSDPV1_PARAMETER(name, initial, ...) std::uint32_t name = initial;
#define DSDPV1_NUMBERS(...) \
  { __VA_ARGS__ }
#define DSDPV1_RSU_LIST(name, initial, ...) std::array<std::uint32_t, 8> name = DSDPV1_NUMBERS initial;
#include "model/dsdpv1/parameters.inc"
#undef DSDPV1_NUMBERS
};

}  // namespace dsdpv1
