#include "model/xgate/diagnosis_block.hpp"

#include "model/profibus/sap_buffers.hpp"

namespace dsdpv1::xgate {
namespace {

constexpr int kDeviceHead = 4, kChannelSize = 3, kLastSlot = 254;
constexpr unsigned kDeviceBlock = 0, kChannelBlock = 2;  // bits 7..6 of a header
constexpr unsigned kStatus = 0x80, kModuleStatus = 0x82;

bool manufacturer_type(unsigned type) { return type >= 32 && type <= 126; }

bool right_type(unsigned type, unsigned slot) {
  if (type == kModuleStatus) return slot == 0;
  if ((type & kStatus) != 0) return type == 0x81 || manufacturer_type(type & 0x7F);
  return (type >= 1 && type <= 6) || manufacturer_type(type);
}

/// The length of an alarm or status block, 0: it is none.
int device_block(const std::uint8_t* block, int size) {
  const int length = block[0] & 0x3F;
  if (length < kDeviceHead || length > size || block[2] > kLastSlot) return 0;
  return right_type(block[1], block[2]) ? length : 0;
}

bool channel_block(const std::uint8_t* block, int size) {
  if (size < kChannelSize || block[0] >> 6 != kChannelBlock) return false;
  const int direction = block[1] >> 6, width = block[2] >> 5, fault = block[2] & 0x1F;
  return direction != 0 && width >= 1 && width <= 6 && ((fault >= 1 && fault <= 9) || fault >= 16);
}

}  // namespace

DiagnosisBlocks read_diagnosis(const std::uint8_t* bytes, int size) {
  DiagnosisBlocks found;
  int at = 0;
  if (size > profibus::kMaxDiag) return found;
  if (size > 0 && bytes[0] >> 6 == kDeviceBlock) {
    at = device_block(bytes, size);
    if (at == 0) return found;
    found.alarm = (bytes[1] & kStatus) == 0;
  }
  for (; at < size; at += kChannelSize) {
    if (!channel_block(bytes + at, size - at)) return found;
    found.channel = true;
  }
  found.right = true;
  return found;
}

}  // namespace dsdpv1::xgate
