#include "bus/master/alarms.hpp"

namespace dsdpv1::bus {

namespace {

constexpr std::size_t kFirstBlock = 6, kAlarmHead = 4;
constexpr unsigned kBlockKind = 0xC0, kBlockLength = 0x3F, kChannelRelated = 0x80, kRevisionNumber = 0xC0,
                   kStatusType = 0x80;

/// Bytes of the block with this header; 0: none can follow.
std::size_t block_size(std::uint8_t header) {
  switch (header & kBlockKind) {
    case kChannelRelated: return 3;
    case kRevisionNumber: return 1;
    default: return header & kBlockLength;
  }
}

}  // namespace

std::optional<AcyclicRequest> alarm_ack_for(const Bytes& diagnosis) {
  for (std::size_t at = kFirstBlock; at < diagnosis.size();) {
    const std::size_t size = block_size(diagnosis[at]);
    if (size == 0 || size > diagnosis.size() - at) return std::nullopt;
    const bool device_related = (diagnosis[at] & kBlockKind) == 0;
    if (device_related && size >= kAlarmHead && (diagnosis[at + 1] & kStatusType) == 0)
      return AcyclicRequest{function_num::kAlarmAck, diagnosis[at + 2], diagnosis[at + 1], diagnosis[at + 3], {}};
    at += size;
  }
  return std::nullopt;
}

}  // namespace dsdpv1::bus
