#pragma once
// The CRC of blocks (4.2, D2) and telegrams (R15). Independent of the driver's and the chip's implementation, because
// it checks both.
#include <cstdint>

namespace dsdpv1::tb {

class Crc16 {
 public:
  void add(std::uint8_t byte) {
    crc_ ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc_ = (crc_ & 1U) != 0 ? crc_ >> 1U ^ 0xA001U : crc_ >> 1U;
  }
  std::uint16_t value() const { return static_cast<std::uint16_t>(crc_); }

 private:
  unsigned crc_ = 0xFFFF;
};

}  // namespace dsdpv1::tb
