#include "lab/compare/levels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "io/input/input_error.hpp"
#include "io/input/units.hpp"

namespace dsdpv1::tb::compare {
namespace {

constexpr std::string_view kLevels = "01xz";

bool level_match(char a, char b, XRule x, ZRule z) {
  if (a == 'x' && b == 'x') return x != XRule::kNever;
  if (a == b) return true;
  if (a == 'x') return x == XRule::kExpected || x == XRule::kAny;
  if (b == 'x') return x == XRule::kAny;
  if (a == 'z') return z == ZRule::kExpected || z == ZRule::kAny;
  return b == 'z' && z == ZRule::kAny;
}

double real(std::string_view text) { return std::strtod(std::string(text).c_str(), nullptr); }

bool same_character(char a, char b) { return a == b || (a == ' ' && b == '_') || (a == '_' && b == ' '); }

std::optional<std::string> bits_of(std::int64_t number, std::uint32_t width) {
  std::string bits(width, '0');
  for (std::size_t i = width; i-- > 0; number >>= 1) bits[i] = (number & 1) != 0 ? '1' : '0';
  if (number != 0) return std::nullopt;
  return bits;
}

}  // namespace

Levels::Levels(XRule x, ZRule z) {
  for (const char a : kLevels)
    for (const char b : kLevels) match_[place(a) * 4 + place(b)] = level_match(a, b, x, z);
}

bool Levels::match(WaveKind kind, std::string_view a, std::string_view b) const {
  if (kind == WaveKind::kBits) return match(a, b);
  if (a == b) return true;
  if (kind == WaveKind::kReal) return real(a) == real(b);  // NaN has one spelling, which was compared already
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), same_character);
}

std::string parse_value(const std::string& text, WaveKind kind, std::uint32_t width, const std::string& what) {
  if (kind != WaveKind::kBits) return text;
  if (text == "x" || text == "z") return std::string(width, text[0]);
  if (text.size() == width && text.find_first_not_of(kLevels) == std::string::npos) return text;
  const std::optional<std::int64_t> number = parse_integer(text);
  const auto bits = number && *number >= 0 ? bits_of(*number, width) : std::nullopt;
  if (bits) return *bits;
  throw InputError(
      fmt::format("{} is {}, expected numbers of {} bits, x, z, and as many of 0, 1, x, z", what, text, width));
}

std::string value_text(std::string_view value, WaveKind kind) {
  if (kind != WaveKind::kBits) return value.empty() ? "nothing" : std::string(value);
  const char first = value.empty() ? 'x' : value.front();
  if (value.find_first_not_of(first) == std::string_view::npos && (first == 'x' || first == 'z'))
    return std::string(1, first);
  if (value.size() == 1 || value.find_first_not_of("01") != std::string_view::npos) return std::string(value);
  std::string text;
  for (std::size_t end = value.size(); end > 0; end -= std::min<std::size_t>(end, 4)) {
    const std::size_t begin = end > 4 ? end - 4 : 0;
    unsigned digit = 0;
    for (std::size_t i = begin; i < end; ++i) digit = digit * 2 + (value[i] == '1' ? 1U : 0U);
    text.insert(text.begin(), "0123456789ABCDEF"[digit]);
  }
  return text;
}

}  // namespace dsdpv1::tb::compare
