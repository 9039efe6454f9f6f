#pragma once
// A host's characters on RXD, each edge where a test puts it.
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "bus/time.hpp"

namespace dsdpv1::checks_test {

using bus::Tick;
using Bytes = std::vector<std::uint8_t>;

/// CRC behind, high byte first (R15), bit by bit.
inline Bytes sealed(Bytes bytes, unsigned error = 0) {
  unsigned crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? (crc >> 1) ^ 0xA001U : crc >> 1;
  }
  crc ^= error;
  bytes.push_back(static_cast<std::uint8_t>(crc >> 8));
  bytes.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
  return bytes;
}

struct LineCharacter {
  std::uint8_t value = 0;
  bool wrong_parity = false, no_stop_bit = false;
};

/// Start, data, parity, stop of one character from `at` on, `bit` ticks each; the end of its stop bit, at which the
/// line is left as it is.
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
