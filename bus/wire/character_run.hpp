#pragma once
// A series of characters as one object: announced by the sender, so that listeners do not need its levels.
#include <cstddef>
#include <cstdint>

#include "bus/address.hpp"
#include "bus/baud.hpp"
#include "bus/time.hpp"

namespace dsdpv1::bus {

/// True when the number of ones in `byte` is odd: the value of the even parity bit.
bool even_parity(std::uint8_t byte);
/// The levels of a character in the order of sending, the start bit lowest.
std::uint16_t frame_of(std::uint8_t byte);

/// Valid characters without a gap.
struct CharacterRun {
  Tick start = 0;  ///< falling edge of the first start bit
  Tick bit = 0;    ///< ticks per bit
  const std::uint8_t* bytes = nullptr;
  std::size_t size = 0;

  Tick character(std::size_t index) const { return start + static_cast<Tick>(index) * kCharacterBits * bit; }
  /// End of the last stop bit.
  Tick end() const { return character(size); }
  /// The level of the line at `at`, not before `start`.
  bool level(Tick at) const;
};

/// Calls `change(at, level)` for each change of the line in the run, falling and rising in turn.
template <class Change>
void for_each_change(const CharacterRun& run, Change change) {
  bool level = true;
  for (std::size_t i = 0; i < run.size; ++i) {
    const unsigned frame = frame_of(run.bytes[i]);
    for (int bit = 0; bit < kCharacterBits; ++bit) {
      const bool sent = ((frame >> bit) & 1U) != 0;
      if (sent != level) change(run.character(i) + bit * run.bit, sent);
      level = sent;
    }
  }
}

/// The addressee of the telegram in these characters, as read by a kind of receiver: a station (0 to 126), kBroadcast,
/// kForNobody (an acknowledgement, a token), or kNoTelegram: not a valid telegram.
using RunReader = int (*)(const std::uint8_t* bytes, std::size_t size);
constexpr int kNoTelegram = -1, kForNobody = 128;

/// Selects the runs that a listener must receive. Others are counted for it, as long as `reader` finds a valid
/// telegram.
struct RunFilter {
  RunReader reader = nullptr;  ///< nullptr: all runs
  Tick from = 0;               ///< runs that begin before ...
  Tick bit = 0;                ///< ... runs of another bit time ...
  std::uint8_t address = 0;    ///< ... and runs for this station and for all
};

}  // namespace dsdpv1::bus
