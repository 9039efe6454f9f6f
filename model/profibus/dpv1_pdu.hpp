#pragma once
// The bytes of a C1 or C2 request or answer (tables 26 to 32).
#include <cstdint>

namespace dsdpv1::profibus::dpv1 {

constexpr std::uint8_t kTransport = 0x51, kAlarmAck = 0x5C, kRead = 0x5E, kWrite = 0x5F;  // Function_Num
constexpr std::uint8_t kIdle = 0x48, kInitiateNow = 0x56, kInitiate = 0x57, kAbort = 0x58;
constexpr std::uint8_t kNegative = 0x80;     // tables 27, 32
constexpr std::uint8_t kErrorDecode = 0x80;  // table 28
constexpr std::uint8_t kNotSupported = 0xA9, kWriteLength = 0xB1, kStateConflict = 0xB5,
                       kInvalidParameter = 0xB8;  // 29
constexpr int kHeader = 4;  ///< Function_Num, slot, index, length; or Function_Num and three error bytes

}  // namespace dsdpv1::profibus::dpv1
