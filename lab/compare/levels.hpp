#pragma once
// Equality of two values.
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/waves/wave_reader.hpp"
#include "lab/compare/options.hpp"

namespace dsdpv1::tb::compare {

class Levels {
 public:
  Levels(XRule x, ZRule z);
  /// Bits (0, 1, x, z), as many on both sides.
  bool match(std::string_view a, std::string_view b) const {
    for (std::size_t i = 0; i < a.size(); ++i)
      if (!match_[place(a[i]) * 4 + place(b[i])]) return false;
    return true;
  }
  /// Compares reals by number and texts except blanks, which a VCD writes as underscores.
  bool match(WaveKind kind, std::string_view a, std::string_view b) const;

 private:
  static std::size_t place(char level) { return level == '0' ? 0U : level == '1' ? 1U : level == 'x' ? 2U : 3U; }
  std::array<bool, 16> match_{};
};

/// A user's value for a signal: "1", "0x3F", "x", "01xz", a real or a text. Throws InputError, whose line
/// begins with `what`.
std::string parse_value(const std::string& text, WaveKind kind, std::uint32_t width, const std::string& what);

/// A value for people: "1", "3F", "0x1z" in binary if not all bits are known.
std::string value_text(std::string_view value, WaveKind kind);

}  // namespace dsdpv1::tb::compare
