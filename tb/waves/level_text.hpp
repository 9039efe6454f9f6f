#pragma once
#include <array>

#include "tb/waves/wave_writer.hpp"

namespace tb {

/// The wires of a level as characters 0, 1, x, z, the highest first, ended by a zero byte.
inline std::array<char, 33> level_text(int level, int width) {
  std::array<char, 33> text{};
  for (int i = 0; i < width; ++i) {
    const auto bit = static_cast<unsigned>(width - 1 - i);
    const char driven = ((static_cast<unsigned>(level) >> bit) & 1U) != 0 ? '1' : '0';
    text[static_cast<std::size_t>(i)] = level == WaveWriter::kReleased  ? 'z'
                                        : level == WaveWriter::kUnknown ? 'x'
                                                                        : driven;
  }
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

}  // namespace tb
