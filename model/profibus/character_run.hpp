#pragma once
// A series of characters as one object, which a bench may pass instead of eleven levels per character.
#include <cstdint>

#include "model/profibus/baud.hpp"

namespace dsdpv1::profibus {

/// Characters with even parity that follow each other without a gap on a line that idles before them.
struct CharacterRun {
  Tick start = 0;  ///< falling edge of the first start bit
  Cycle bit = 0;   ///< cycles per bit, exactly
  const std::uint8_t* bytes = nullptr;
  int size = 0;
};

/// The eleven levels of a character in the order of sending, the start bit lowest.
constexpr unsigned frame_of(std::uint8_t value) {
  const unsigned parity = static_cast<unsigned>(__builtin_popcount(value)) & 1U;
  return (1U << 10) | (parity << 9) | (static_cast<unsigned>(value) << 1);
}

}  // namespace dsdpv1::profibus
