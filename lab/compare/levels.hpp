#pragma once
// When two values are the same.
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
  /// Reals by their number, texts but for blanks, which a VCD has as underlines.
  bool match(WaveKind kind, std::string_view a, std::string_view b) const;

 private:
  static std::size_t place(char level) { return level == '0' ? 0U : level == '1' ? 1U : level == 'x' ? 2U : 3U; }
  std::array<bool, 16> match_{};
};

/// A value as people write it, for a signal: "1", "0x3F", "x", "01xz", a real or a text. Throws InputError, whose line
/// begins with `what`.
std::string parse_value(const std::string& text, WaveKind kind, std::uint32_t width, const std::string& what);

/// A value as people read it: "1", "3F", "0x1z" in binary where not all bits are known.
std::string value_text(std::string_view value, WaveKind kind);

}  // namespace dsdpv1::tb::compare
