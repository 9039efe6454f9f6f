#pragma once
// Characters told as a whole: who sends them tells them before, and who hears them so needs none of their levels.
#include <cstddef>
#include <cstdint>

#include "bus/baud.hpp"
#include "bus/time.hpp"

namespace bus {

/// True when the number of ones in `byte` is odd: the value of the even parity bit.
bool even_parity(std::uint8_t byte);
/// The levels of a character in the order of sending, the start bit lowest.
std::uint16_t frame_of(std::uint8_t byte);

/// Right characters without a gap.
struct CharacterRun {
  Tick start = 0;  ///< falling edge of the first start bit
  Tick bit = 0;    ///< ticks of a bit
  const std::uint8_t* bytes = nullptr;
  std::size_t size = 0;

  Tick character(std::size_t index) const { return start + static_cast<Tick>(index) * kCharacterBits * bit; }
  /// End of the last stop bit.
  Tick end() const { return character(size); }
  /// The level of the line at `at`, not before `start`.
  bool level(Tick at) const;
};

}  // namespace bus
