#include "bus/capture/link_type.hpp"

#include <fmt/format.h>

#include "bus/capture/captured_telegram.hpp"

namespace dsdpv1::bus::capture {

std::optional<std::uint16_t> link_type(const std::string& word) {
  if (word == "profibus") return static_cast<std::uint16_t>(kProfibusLink);
  for (std::uint32_t link = kFirstUserLink; link <= kLastUserLink; ++link)
    if (word == fmt::format("user{}", link - kFirstUserLink)) return static_cast<std::uint16_t>(link);
  return std::nullopt;
}

void check_link(std::uint32_t link) {
  if (!may_be_profibus(link))
    throw CaptureError(fmt::format("packets of link type {}, expected {} (PROFIBUS) and {} to {} (USER0 to USER15)",
                                   link, kProfibusLink, kFirstUserLink, kLastUserLink));
}

}  // namespace dsdpv1::bus::capture
