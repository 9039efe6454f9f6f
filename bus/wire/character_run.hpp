#pragma once
// Characters told as a whole: who sends them tells them before, and who hears them so needs none of their levels.
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

/// Calls `change(at, level)` for each change of the line that a run is, falling and rising in turn.
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

/// Who the telegram in these characters is for, as a kind of receiver reads it: a station (0 to 126), kBroadcast,
/// kForNobody (an acknowledgement, a token), or kNoTelegram: it is no right telegram.
using RunReader = int (*)(const std::uint8_t* bytes, std::size_t size);
constexpr int kNoTelegram = -1, kForNobody = 128;

/// Runs that a listener acts on. Others are counted for it, as long as each is a right telegram as `reader` reads it.
struct RunFilter {
  RunReader reader = nullptr;  ///< nullptr: it acts on every run
  Tick from = 0;               ///< it acts on those that begin before, too ...
  Tick bit = 0;                ///< ... on those of another bit time ...
  std::uint8_t address = 0;    ///< ... and on those for this station and for all
};

}  // namespace dsdpv1::bus
