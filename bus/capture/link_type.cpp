#include "bus/capture/link_type.hpp"

#include <fmt/format.h>

namespace bus::capture {

std::optional<std::uint16_t> link_type(const std::string& word) {
  if (word == "profibus") return static_cast<std::uint16_t>(kProfibusLink);
  for (std::uint32_t link = kFirstUserLink; link <= kLastUserLink; ++link)
    if (word == fmt::format("user{}", link - kFirstUserLink)) return static_cast<std::uint16_t>(link);
  return std::nullopt;
}

}  // namespace bus::capture
