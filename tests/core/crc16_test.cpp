// Ruling D2, chapter 4.2.
#include "model/dpram/crc16.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace dsdpv1::dpram {
namespace {

/// Steps 1 to 7 of chapter 4.2, literally.
std::uint16_t by_the_steps(const std::vector<std::uint8_t>& bytes) {
  unsigned crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int shift = 0; shift < 8; ++shift) {
      const bool lsb = (crc & 1U) != 0;
      crc >>= 1;
      if (lsb) crc ^= 0xA001U;
    }
  }
  return static_cast<std::uint16_t>(crc);
}

TEST(Crc16, ExampleOfTheDatasheet) {
  const std::uint8_t bytes[] = {0x02, 0x07};
  EXPECT_EQ(crc16(bytes, 2), 0x1241);
}

TEST(Crc16, NoBytesLeaveTheInitialValue) { EXPECT_EQ(crc16(nullptr, 0), 0xFFFF); }

TEST(Crc16, AgreesWithTheStepsForRandomBlocks) {
  std::mt19937 random(1);
  for (int round = 0; round < 2000; ++round) {
    std::vector<std::uint8_t> bytes(random() % 260);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    ASSERT_EQ(crc16(bytes.data(), static_cast<int>(bytes.size())), by_the_steps(bytes));
  }
}

TEST(Crc16, EverySingleBitFlipIsSeen) {
  std::vector<std::uint8_t> bytes(245, 0x5A);
  const std::uint16_t right = crc16(bytes.data(), 245);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      bytes[i] = static_cast<std::uint8_t>(bytes[i] ^ (1U << bit));
      ASSERT_NE(crc16(bytes.data(), 245), right);
      bytes[i] = static_cast<std::uint8_t>(bytes[i] ^ (1U << bit));
    }
  }
}

}  // namespace
}  // namespace dsdpv1::dpram
