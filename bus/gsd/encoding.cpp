// The encoding of GSD files: 8-bit text, in practice ASCII, Latin-1, UTF-8 with or without a byte order mark, with the
// end marks of old editors.
#include <fmt/format.h>

#include <algorithm>

#include "bus/gsd/text.hpp"
#include "bus/utf8.hpp"

namespace dsdpv1::bus::gsd {
namespace {

constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";

bool is_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t size = utf8_sequence(text, at);
    if (size == 0) return false;
    at += size;
  }
  return true;
}

std::string from_latin1(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      result += c;
    } else {
      result += static_cast<char>(0xC0U | (byte >> 6U));
      result += static_cast<char>(0x80U | (byte & 0x3FU));
    }
  }
  return result;
}

bool is_text_byte(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 0x20 ? byte != 0x7F : byte == '\t' || byte == '\n' || byte == '\r' || byte == '\f' || byte == '\v';
}

int line_of(std::string_view text, std::size_t at) {
  const auto begin = text.begin();
  const auto end = begin + static_cast<std::ptrdiff_t>(at);
  const auto feeds = std::count(begin, end, '\n');
  return static_cast<int>(feeds != 0 ? feeds : std::count(begin, end, '\r')) + 1;
}

/// DOS editors end a text with 0x1A, some tools pad it with NUL.
void drop_end_marks(std::string& bytes) {
  while (!bytes.empty() && (bytes.back() == '\0' || bytes.back() == '\x1A')) bytes.pop_back();
}

}  // namespace

std::string decode(std::string bytes, Diagnostics& diagnostics) {
  if (bytes.compare(0, 2, "\xFF\xFE") == 0 || bytes.compare(0, 2, "\xFE\xFF") == 0) {
    diagnostics.error(1, "the file is UTF-16, 8-bit text (ASCII, Latin-1, UTF-8) is allowed");
    return {};
  }
  drop_end_marks(bytes);
  if (bytes.compare(0, kUtf8Mark.size(), kUtf8Mark) == 0) bytes.erase(0, kUtf8Mark.size());
  const auto alien = std::find_if_not(bytes.begin(), bytes.end(), is_text_byte);
  if (alien != bytes.end()) {
    const auto at = static_cast<std::size_t>(alien - bytes.begin());
    diagnostics.error(line_of(bytes, at),
                      fmt::format("byte 0x{:02X} is no text, a GSD file holds printable characters, tabs "
                                  "and line ends",
                                  static_cast<unsigned char>(*alien)));
    return {};
  }
  return is_utf8(bytes) ? bytes : from_latin1(bytes);
}

}  // namespace dsdpv1::bus::gsd
