#pragma once
// Numbers of the pcapng format, for its writer and its reader.
#include <cstdint>

namespace dsdpv1::bus::capture::pcapng {

constexpr std::uint32_t kSection = 0x0A0D0D0A, kInterface = 1, kOldPacket = 2, kSimplePacket = 3, kPacket = 6;
constexpr std::uint32_t kByteOrder = 0x1A2B3C4D;
/// Type and length before a block's body, the length again after it.
constexpr std::uint32_t kBlockFrame = 12;

namespace option {
constexpr std::uint16_t kEnd = 0, kComment = 1;
constexpr std::uint16_t kApplication = 4;                                                            // section
constexpr std::uint16_t kName = 2, kDescription = 3, kSpeed = 8, kResolution = 9, kTimeOffset = 14;  // interface
constexpr std::uint16_t kFlags = 2;                                                                  // packet
}  // namespace option

}  // namespace dsdpv1::bus::capture::pcapng
