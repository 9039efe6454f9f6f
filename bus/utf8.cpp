#include "bus/utf8.hpp"

#include <algorithm>
#include <iterator>

namespace dsdpv1::bus {
namespace {

/// The well-formed sequences of Unicode, by their first byte; bytes after the second are 80..BF.
struct Utf8Form {
  unsigned char first_low, first_high, size;
  unsigned char second_low, second_high;
};
constexpr Utf8Form kUtf8Forms[] = {
    {0x00, 0x7F, 1, 0x00, 0xFF}, {0xC2, 0xDF, 2, 0x80, 0xBF}, {0xE0, 0xE0, 3, 0xA0, 0xBF},
    {0xE1, 0xEC, 3, 0x80, 0xBF}, {0xED, 0xED, 3, 0x80, 0x9F}, {0xEE, 0xEF, 3, 0x80, 0xBF},
    {0xF0, 0xF0, 4, 0x90, 0xBF}, {0xF1, 0xF3, 4, 0x80, 0xBF}, {0xF4, 0xF4, 4, 0x80, 0x8F},
};

}  // namespace

std::size_t utf8_sequence(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[at + i]); };
  const auto begins = [&](const Utf8Form& form) { return byte(0) >= form.first_low && byte(0) <= form.first_high; };
  const auto* const form = std::find_if(std::begin(kUtf8Forms), std::end(kUtf8Forms), begins);
  if (form == std::end(kUtf8Forms) || form->size > text.size() - at) return 0;
  if (form->size > 1 && (byte(1) < form->second_low || byte(1) > form->second_high)) return 0;
  for (std::size_t i = 2; i < form->size; ++i)
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
  return form->size;
}

}  // namespace dsdpv1::bus
