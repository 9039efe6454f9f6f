#pragma once
#include <algorithm>
#include <array>
#include <cstddef>

#include "io/waves/wave_writer.hpp"

namespace dsdpv1::tb {

/// The wires of a level as characters 0, 1, x, z, the highest first, ended by a zero byte.
inline std::array<char, 33> level_text(int level, int width) {
  std::array<char, 33> text{};
  const auto wires = static_cast<std::size_t>(width);
  if (level == WaveWriter::kReleased || level == WaveWriter::kUnknown) {
    std::fill_n(text.begin(), wires, level == WaveWriter::kReleased ? 'z' : 'x');
    return text;
  }
  auto rest = static_cast<unsigned>(level);
  for (std::size_t i = wires; i-- > 0; rest >>= 1U) text[i] = (rest & 1U) != 0 ? '1' : '0';
  return text;
}

/// 0, 1, x or z for a level as simulators spell it, VHDL's nine among them (U, W and - are x, H is 1, L is 0); a zero
/// byte for anything else.
constexpr char level_of(char c) {
  switch (c) {
    case '0':
    case 'L':
    case 'l': return '0';
    case '1':
    case 'H':
    case 'h': return '1';
    case 'z':
    case 'Z': return 'z';
    case 'x':
    case 'X':
    case 'u':
    case 'U':
    case 'w':
    case 'W':
    case '-': return 'x';
    default: return '\0';
  }
}

}  // namespace dsdpv1::tb
