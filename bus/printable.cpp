#include "bus/printable.hpp"

#include <fmt/format.h>

#include <cstddef>

#include "bus/utf8.hpp"

namespace dsdpv1::bus {
namespace {

/// Requires a well-formed sequence.
unsigned code_point(std::string_view sequence) {
  const auto first = static_cast<unsigned char>(sequence[0]);
  if (sequence.size() == 1) return first;
  unsigned code = first & (0x7FU >> sequence.size());
  for (const char c : sequence.substr(1)) code = code << 6U | (static_cast<unsigned char>(c) & 0x3FU);
  return code;
}

bool is_within(unsigned code, unsigned first, unsigned last) { return code >= first && code <= last; }

bool is_control(unsigned code) { return code < 0x20 || is_within(code, 0x7F, 0x9F); }

/// Line and paragraph separators, and the controls of Unicode's bidirectional algorithm.
bool is_order(unsigned code) {
  return is_within(code, 0x2028, 0x202E) || is_within(code, 0x2066, 0x2069) || is_within(code, 0x200E, 0x200F) ||
         code == 0x061C;
}

std::string escaped(unsigned code) {
  switch (code) {
    case '\n': return "\\n";
    case '\r': return "\\r";
    case '\t': return "\\t";
    default: return code < 0x80 ? fmt::format("\\x{:02X}", code) : fmt::format("\\u{:04X}", code);
  }
}

/// Appends the character at `at` and returns its size in bytes.
std::size_t add(std::string_view text, std::size_t at, std::string& result) {
  const std::size_t size = utf8_sequence(text, at);
  if (size == 0) {
    result += fmt::format("\\x{:02X}", static_cast<unsigned char>(text[at]));
    return 1;
  }
  const unsigned code = code_point(text.substr(at, size));
  if (is_control(code) || is_order(code))
    result += escaped(code);
  else
    result += text.substr(at, size);
  return size;
}

std::string made_printable(std::string_view text, std::string_view kept) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t at = 0; at < text.size();)
    if (kept.find(text[at]) != std::string_view::npos)
      result += text[at++];
    else
      at += add(text, at, result);
  return result;
}

}  // namespace

std::string printable(std::string_view text) { return made_printable(text, ""); }

std::string printable_lines(std::string_view text) { return made_printable(text, "\n\t"); }

}  // namespace dsdpv1::bus
