#pragma once
// A chip's configuration at construction: its name, and the parameters of the rulings marked (p).
#include <cstdint>

#include "model/spc3/variant.hpp"
#include "registers/spc3_regs.hpp"

namespace dsdpv1::spc3 {

using regs::Address;

enum class Engine : std::uint8_t {
  kStep,  ///< every cycle of every block is evaluated
  kSkip,  ///< jumps to the next cycle with an event; the same pin trace
};

/// The parameters of the rulings marked (p), with their defaults; parameters.inc has meaning, unit and range.
struct Config {
  Engine engine = Engine::kSkip;
  Variant variant = Variant::kApc3;
#define SPC3_PARAMETER(name, initial, ...) std::uint32_t name = initial;
#include "model/spc3/parameters.inc"
};

/// A44: a delay in cycles of 48 MHz.
constexpr std::int64_t delay_of(const Config& config, std::uint32_t clocks) {
  return std::int64_t{clocks} * (config.clock == 24 ? 2 : 1);
}

}  // namespace dsdpv1::spc3
