#pragma once
// A host's characters on RXD, each edge where a test puts it.
#include <cstdint>
#include <functional>
#include <utility>

#include "bus/time.hpp"

namespace dsdpv1::checks_test {

using bus::Tick;

struct LineCharacter {
  std::uint8_t value = 0;
  bool wrong_parity = false, no_stop_bit = false;
};

/// Sends start, data, parity, stop of one character from `at` on, `bit` ticks each; returns the end of its stop bit,
/// after which the line keeps its level.
inline Tick put_character(const std::function<void(Tick, bool)>& set, Tick at, Tick bit,
                          const LineCharacter& character) {
  bool parity = character.wrong_parity, line = true;
  const auto put = [&](int cell, bool level) {
    if (std::exchange(line, level) != level) set(at + cell * bit, level);
  };
  put(0, false);
  for (int i = 0; i < 8; ++i) {
    const bool one = (character.value >> i & 1) != 0;
    parity = parity != one;
    put(1 + i, one);
  }
  put(9, parity);
  put(10, !character.no_stop_bit);
  put(11, true);
  return at + 11 * bit;
}

}  // namespace dsdpv1::checks_test
