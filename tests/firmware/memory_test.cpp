// The board's replacements for C library functions, compared with the host's.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstring>

extern "C" {
void* firmware_memcpy(void* to, const void* from, std::size_t size);
void* firmware_memmove(void* to, const void* from, std::size_t size);
void* firmware_memset(void* to, int value, std::size_t size);
int firmware_memcmp(const void* a, const void* b, std::size_t size);
std::size_t firmware_strlen(const char* text);
}

namespace {

using Bytes = std::array<unsigned char, 16>;

constexpr Bytes kCounting = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

int sign(int value) { return (value > 0 ? 1 : 0) - (value < 0 ? 1 : 0); }

TEST(FirmwareMemory, CopiesExactlySoManyBytes) {
  for (std::size_t size = 0; size <= kCounting.size(); ++size) {
    Bytes own{}, host{};
    EXPECT_EQ(firmware_memcpy(own.data(), kCounting.data(), size), own.data());
    std::memcpy(host.data(), kCounting.data(), size);
    EXPECT_EQ(own, host) << size;
  }
}

TEST(FirmwareMemory, MovesOverlappingBytesUpAndDown) {
  for (std::size_t from = 0; from < 8; ++from) {
    for (std::size_t to = 0; to < 8; ++to) {
      Bytes own = kCounting, host = kCounting;
      EXPECT_EQ(firmware_memmove(own.data() + to, own.data() + from, 8), own.data() + to);
      std::memmove(host.data() + to, host.data() + from, 8);
      EXPECT_EQ(own, host) << from << " to " << to;
    }
  }
}

TEST(FirmwareMemory, FillsWithTheLowByteOfTheValue) {
  Bytes own = kCounting, host = kCounting;
  EXPECT_EQ(firmware_memset(own.data() + 3, 0x1A5, 5), own.data() + 3);
  std::memset(host.data() + 3, 0xA5, 5);
  EXPECT_EQ(own, host);
}

TEST(FirmwareMemory, ComparesAsUnsignedBytes) {
  const Bytes low = {1, 0x7F}, high = {1, 0x80};
  for (std::size_t size = 0; size <= 2; ++size) {
    EXPECT_EQ(sign(firmware_memcmp(low.data(), high.data(), size)), sign(std::memcmp(low.data(), high.data(), size)));
    EXPECT_EQ(sign(firmware_memcmp(high.data(), low.data(), size)), sign(std::memcmp(high.data(), low.data(), size)));
  }
}

TEST(FirmwareMemory, MeasuresTexts) {
  for (const char* text : {"", "a", "DSDPV1-EVAL"}) EXPECT_EQ(firmware_strlen(text), std::strlen(text));
}

}  // namespace
