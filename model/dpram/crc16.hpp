#pragma once
// CRC-16 of chapter 4.2 (ruling D2): polynomial 0xA001 reflected, initial value 0xFFFF; 02 07 gives 0x1241.
#include <array>
#include <cstdint>

namespace dsdpv1::dpram {

namespace detail {
constexpr std::array<std::uint16_t, 256> make_crc16_table() {
  std::array<std::uint16_t, 256> table{};
  for (unsigned byte = 0; byte < 256; ++byte) {
    unsigned crc = byte;
    for (int shift = 0; shift < 8; ++shift) crc = (crc & 1U) != 0 ? (crc >> 1) ^ 0xA001U : crc >> 1;
    table[byte] = static_cast<std::uint16_t>(crc);
  }
  return table;
}
inline constexpr std::array<std::uint16_t, 256> kCrc16Table = make_crc16_table();
}  // namespace detail

constexpr std::uint16_t kCrc16Start = 0xFFFF;
/// `crc` extended by `byte`.
constexpr std::uint16_t crc16_with(std::uint16_t crc, std::uint8_t byte) {
  return static_cast<std::uint16_t>((crc >> 8) ^ detail::kCrc16Table[(crc ^ byte) & 0xFF]);
}

/// CRC over `size` bytes in order of their addresses.
inline std::uint16_t crc16(const std::uint8_t* bytes, int size) {
  unsigned crc = 0xFFFF;
  for (int i = 0; i < size; ++i) crc = (crc >> 8) ^ detail::kCrc16Table[(crc ^ bytes[i]) & 0xFF];
  return static_cast<std::uint16_t>(crc);
}

}  // namespace dsdpv1::dpram
