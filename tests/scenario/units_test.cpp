// Times and bytes as people write them.
#include <gtest/gtest.h>

#include "io/input/units.hpp"

namespace dsdpv1 {
namespace {

TEST(Time, IsReadExactlyInTicksOfATwelfthOfANanosecond) {
  EXPECT_EQ(tb::parse_time("250ns"), 3000);
  EXPECT_EQ(tb::parse_time("0.25ns"), 3);
  EXPECT_EQ(tb::parse_time("1.5ms"), 18'000'000);
  EXPECT_EQ(tb::parse_time("20us"), 240'000);
  EXPECT_EQ(tb::parse_time("2 s"), 24'000'000'000);
  EXPECT_EQ(tb::parse_time("48cycles"), 12'000);
  EXPECT_EQ(tb::parse_time("3600s"), 3600 * bus::kTicksPerSecond);
}

TEST(Time, IsRoundedOnceToTheNearestTick) {
  EXPECT_EQ(tb::parse_time("20.8333ns"), 250);
  EXPECT_EQ(tb::parse_time("0.04ns"), 0);
  EXPECT_EQ(tb::parse_time("0.05ns"), 1);
  EXPECT_EQ(tb::parse_time("0.999999999s"), 11'999'999'988);
}

TEST(Time, MayBeNegative) {
  EXPECT_EQ(tb::parse_time("-5ns"), -60);
  EXPECT_FALSE(tb::parse_time("--5ns"));
}

TEST(Time, WithoutUnitOrWithAWrongOneIsRefused) {
  for (const char* text : {"", "20", "us", "20 parsec", "1.us", ".5us", "1e3us", "1000000000s", "20us ",
                           "99999999999999999999s", "1.0000000001s"})
    EXPECT_FALSE(tb::parse_time(text)) << text;
}

TEST(Time, TextReadsBackAsTheSameTime) {
  for (const bus::Tick ticks :
       {bus::Tick{0}, bus::Tick{12}, bus::Tick{3}, bus::Tick{250}, bus::Tick{-60}, bus::Tick{18'000'000},
        bus::Tick{1'200'000'000}, bus::Tick{123'456'789}, bus::Tick{43'200'000'000'000}})
    EXPECT_EQ(tb::parse_time(tb::time_text(ticks)), ticks) << tb::time_text(ticks);
  EXPECT_EQ(tb::time_text(18'000'000), "1.5ms");
}

TEST(Bytes, AreHexadecimalWithRepetition) {
  EXPECT_EQ(tb::parse_bytes("01 a0 FF*3"), (bus::Bytes{1, 0xA0, 0xFF, 0xFF, 0xFF}));
  EXPECT_EQ(tb::parse_bytes("  "), bus::Bytes{});
  EXPECT_EQ(tb::parse_bytes("00*244")->size(), 244U);
}

TEST(Bytes, OtherTextIsRefused) {
  for (const char* text : {"1", "0x01", "0102", "GG", "01*", "01*x", "01*9999", "*3"})
    EXPECT_FALSE(tb::parse_bytes(text)) << text;
}

TEST(Bytes, LongTextIsCut) { EXPECT_EQ(tb::bytes_text({1, 2, 3}, 2), "01 02 ... (3 bytes)"); }

}  // namespace
}  // namespace dsdpv1
