#pragma once
// Link types of packets that hold PROFIBUS telegrams.
#include <cstdint>
#include <optional>
#include <string>

namespace dsdpv1::bus::capture {

/// LINKTYPE_PROFIBUS_DL: a packet is a telegram from its start delimiter to its end delimiter, without a header.
constexpr std::uint32_t kProfibusLink = 257;
/// LINKTYPE_USER0 to LINKTYPE_USER15: user-defined, here the same packets.
constexpr std::uint32_t kFirstUserLink = 147, kLastUserLink = 162;

constexpr bool may_be_profibus(std::uint32_t link) {
  return link == kProfibusLink || (link >= kFirstUserLink && link <= kLastUserLink);
}

/// "profibus", "user0" to "user15"; nullopt for another word.
std::optional<std::uint16_t> link_type(const std::string& word);
/// The words that `link_type` knows, for error lines.
constexpr const char* kLinkWords = "profibus, user0 to user15";

/// Throws CaptureError unless packets of this type may be telegrams.
void check_link(std::uint32_t link);

}  // namespace dsdpv1::bus::capture
