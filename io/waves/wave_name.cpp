#include "io/waves/wave_name.hpp"

#include <charconv>

namespace dsdpv1::tb {
namespace {

std::optional<int> number(std::string_view text) {
  int value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || result.ec != std::errc() || result.ptr != text.data() + text.size()) return std::nullopt;
  return value;
}

/// "7:0" or "7".
std::optional<std::pair<int, int>> parse_range(std::string_view text) {
  const std::size_t colon = text.find(':');
  const std::optional<int> left = number(text.substr(0, colon));
  const std::optional<int> right = colon == std::string_view::npos ? left : number(text.substr(colon + 1));
  if (!left || !right) return std::nullopt;
  return std::pair(*left, *right);
}

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

}  // namespace

WaveName parse_wave_name(std::string_view text, std::uint32_t width) {
  text = without_blanks(text);
  const bool escaped = !text.empty() && text.front() == '\\';
  if (escaped) text.remove_prefix(1);
  const std::size_t blank = text.find(' '), bracket = text.rfind('[');
  const bool apart = blank != std::string_view::npos;  // after an escaped name a range needs a blank
  if (text.empty() || text.back() != ']' || bracket == std::string_view::npos || (escaped && !apart))
    return {std::string(text), std::nullopt};
  const std::string_view inside = text.substr(bracket + 1, text.size() - bracket - 2);
  const auto range = parse_range(inside);
  const bool word = inside.find(':') == std::string_view::npos && width != 1;
  if (!range || word || bracket == 0) return {std::string(text), std::nullopt};
  return {std::string(without_blanks(text.substr(0, bracket))), range};
}

void WaveScopes::open(std::string_view name) {
  if (!name.empty() && name.front() == '\\') name.remove_prefix(1);
  const std::string& above = to_.scopes[current()];
  enter(above.empty() ? std::string(name) : above + "." + std::string(name));
}

void WaveScopes::enter(const std::string& path) {
  const auto [place, fresh] = known_.emplace(path, static_cast<std::uint32_t>(to_.scopes.size()));
  if (fresh) to_.scopes.push_back(path);
  open_.push_back(place->second);
}

bool WaveScopes::close() {
  if (open_.size() == 1) return false;
  open_.pop_back();
  return true;
}

}  // namespace dsdpv1::tb
