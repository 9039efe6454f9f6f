// The baud index: the ten rates in the order of the search, their codes, and none.
#include "model/profibus/baud.hpp"

#include <gtest/gtest.h>

#include <type_traits>

namespace dsdpv1::profibus {
namespace {

static_assert(std::is_trivially_copyable_v<BaudIndex> && sizeof(BaudIndex) == sizeof(int), "as cheap as an int");
static_assert(!std::is_convertible_v<int, BaudIndex> && !std::is_constructible_v<BaudIndex, int>, "no other numbers");
static_assert(!std::is_convertible_v<BaudIndex, int>, "15 is no index into a table");

// From 12 Mbit/s to 9.6 kbit/s: S2's cycles of 48 MHz a bit; S3's max_TSDR, which the software manual's chapter 11 has.
constexpr int kCycles[] = {4, 8, 16, 32, 96, 256, 512, 1056, 2500, 5000};
constexpr int kLatest[] = {800, 450, 250, 150, 100, 60, 60, 250, 60, 60};

TEST(BaudIndexTest, SearchGoesThroughTheTenRatesFromTheFastestAndBeginsAgain) {
  BaudIndex index = BaudIndex::fastest();
  for (int code = 0; code < kBaudCount; ++code, index = index.next()) {
    EXPECT_TRUE(index.known());
    EXPECT_EQ(index.code(), code);
    EXPECT_EQ(index.bit_cycles(), kCycles[code]);
    EXPECT_EQ(index.max_tsdr(), kLatest[code]);
    EXPECT_NE(index, kBaudUnknown);
    EXPECT_EQ(index == BaudIndex::fastest(), code == 0);
  }
  EXPECT_EQ(index, BaudIndex::fastest());
}

TEST(BaudIndexTest, NoneIsFifteenInTable5AndTheSearchBeginsBehindIt) {
  EXPECT_FALSE(kBaudUnknown.known());
  EXPECT_EQ(kBaudUnknown.code(), 15);
  EXPECT_EQ(kBaudUnknown.next(), BaudIndex::fastest());
  EXPECT_EQ(BaudIndex(), kBaudUnknown);
}

}  // namespace
}  // namespace dsdpv1::profibus
