#include "bus/capture/captured_telegram.hpp"

#include <utility>

namespace dsdpv1::bus::capture {

std::string damage_words(std::uint32_t damage) {
  static constexpr std::pair<std::uint32_t, const char*> kWords[] = {{damage::kCharacter, "wrong character"},
                                                                     {damage::kStartDelimiter, "no start delimiter"},
                                                                     {damage::kShape, "wrong lengths or delimiters"},
                                                                     {damage::kGap, "wrong idle time"},
                                                                     {damage::kShort, "cut off"},
                                                                     {damage::kFcs, "wrong FCS"}};
  std::string text;
  for (const auto& [bit, words] : kWords)
    if ((damage & bit) != 0) text += (text.empty() ? "" : ", ") + std::string(words);
  return text.empty() && (damage & damage::kAll) != 0 ? "damaged" : text;
}

}  // namespace dsdpv1::bus::capture
