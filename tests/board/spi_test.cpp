// SPI of the ARM board by its registers, cycle by cycle of HCLK: RM0008, chapter SPI.
#include "board/stm32/spi.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tuple>
#include <vector>

namespace dsdpv1::arm {
namespace {

using testing::ElementsAre;

constexpr std::uint32_t kCr1 = 0x00, kCr2 = 0x04, kSr = 0x08, kDr = 0x0C;
constexpr std::uint32_t kMaster = 1U << 2U, kEnabled = 1U << 6U, kLsbFirst = 1U << 7U, kSsi = 1U << 8U, kSsm = 1U << 9U,
                        kSixteen = 1U << 11U;
constexpr std::uint32_t kRxne = 0x01, kTxe = 0x02, kModf = 0x20, kOvr = 0x40, kBsy = 0x80;
constexpr std::uint32_t kBy8 = 2U << 3U;  // BR: a bit is 8 cycles of PCLK, half of one 4
constexpr std::uint32_t kOn = kMaster | kEnabled | kSsm | kSsi | kBy8;

struct Edge {
  std::uint64_t at;
  bool level;
  bool operator==(const Edge& other) const { return at == other.at && level == other.level; }
};
void PrintTo(const Edge& edge, std::ostream* out) { *out << edge.at << (edge.level ? " up" : " down"); }

class SpiBlock : public testing::Test {
 protected:
  /// Up to and including cycle `end`; `answer` is shifted in on MISO, most significant bit first, at each rise of SCK.
  void run_until(std::uint64_t end) {
    while (spi.next() <= end) {
      now = spi.next();
      const bool sck = spi.sck(), mosi = spi.mosi();
      spi.run((answer >> (7 - falls_since % 8) & 1U) != 0);
      if (spi.sck() != sck) clock.push_back({now, spi.sck()});
      if (spi.mosi() != mosi) data.push_back({now, spi.mosi()});
      if (sck && !spi.sck()) ++falls_since;
    }
    now = end;
  }
  /// The cycle, up to `end`, at which these flags of SR change to the state `set`.
  std::uint64_t when(std::uint32_t flags, bool set, std::uint64_t end) {
    while (((spi.peek(kSr) & flags) == flags) != set) {
      if (spi.next() > end) return 0;
      run_until(spi.next());
    }
    return now;
  }
  Spi spi;
  std::uint64_t now = 0;
  unsigned answer = 0xFF, falls_since = 0;
  std::vector<Edge> clock, data;
};

TEST_F(SpiBlock, ByteOfMode0IsSixteenEdgesHalfABitApart) {
  spi.write(kCr1, kOn, 0);
  spi.write(kDr, 0xA5, 100);
  run_until(1000);
  std::vector<Edge> expected;
  for (std::uint64_t i = 0; i < 16; ++i) expected.push_back({101 + 4 * (i + 1), i % 2 == 0});
  EXPECT_EQ(clock, expected);
  // 1010 0101: the first bit with the load, the others at SCK's falls.
  EXPECT_THAT(data, ElementsAre(Edge{101, true}, Edge{109, false}, Edge{117, true}, Edge{125, false}, Edge{141, true},
                                Edge{149, false}, Edge{157, true}));
}

TEST_F(SpiBlock, FlagsFollowBufferAndShiftRegister) {
  spi.write(kCr1, kOn, 0);
  EXPECT_EQ(spi.peek(kSr), kTxe);
  spi.write(kDr, 0x01, 100);
  EXPECT_EQ(spi.peek(kSr), kBsy);  // TXE is 0 until the buffer has gone to the shift register
  EXPECT_EQ(when(kTxe, true, 1000), 101U);
  EXPECT_EQ(when(kRxne, true, 1000), 101U + 15 * 4);  // the last sampling edge
  EXPECT_EQ(when(kBsy, false, 1000), 101U + 16 * 4);
  EXPECT_EQ(spi.peek(kSr), kTxe | kRxne);
  EXPECT_EQ(spi.next(), Spi::kNever);
}

TEST_F(SpiBlock, SecondByteFollowsWithoutAGapAndTxeRisesWithItsFirstBit) {
  spi.write(kCr1, kOn, 0);
  spi.write(kDr, 0x00, 100);
  run_until(105);
  spi.write(kDr, 0x80, 105);
  EXPECT_EQ(spi.peek(kSr) & kTxe, 0U);
  EXPECT_EQ(when(kTxe, true, 1000), 101U + 64);
  EXPECT_NE(spi.peek(kSr) & kBsy, 0U);
  spi.read(kDr);
  run_until(1000);
  ASSERT_EQ(clock.size(), 32U);
  EXPECT_EQ(clock[16], (Edge{101 + 17 * 4, true}));
  EXPECT_EQ(data, (std::vector<Edge>{{101 + 64, true}, {101 + 72, false}}));
}

TEST_F(SpiBlock, MisoIsTakenAtTheRisesAndStaysInDrUntilRead) {
  answer = 0x3C;
  spi.write(kCr1, kOn, 0);
  spi.write(kDr, 0, 0);
  run_until(1000);
  EXPECT_EQ(spi.read(kDr), 0x3CU);
  EXPECT_EQ(spi.read(kSr), kTxe);
  EXPECT_EQ(spi.read(kDr), 0x3CU);
}

TEST_F(SpiBlock, ByteThatFindsRxneIsLostAndSoAreTheNextUntilOvrIsCleared) {
  spi.write(kCr1, kOn, 0);
  const auto transfer = [this](unsigned value) {
    answer = value;
    spi.write(kDr, 0, now);
    run_until(now + 100);
  };
  transfer(0x11);
  spi.write(kDr, 0, now);
  answer = 0x22;
  EXPECT_EQ(when(kOvr, true, 10'000), 101U + 15 * 4);  // the last sampling edge of the second
  run_until(now + 50);
  EXPECT_EQ(spi.read(kDr), 0x11U);
  transfer(0x33);
  EXPECT_EQ(spi.peek(kSr), kTxe | kOvr);
  EXPECT_EQ(spi.read(kSr), kTxe | kOvr);  // DR has been read before, so this read clears it
  EXPECT_EQ(spi.read(kSr), kTxe);
  transfer(0x44);
  EXPECT_EQ(spi.read(kDr), 0x44U);
  EXPECT_EQ(spi.lost(), 2U);
}

TEST_F(SpiBlock, OvrStandsAsLongAsDrIsNotReadBeforeSr) {
  spi.write(kCr1, kOn, 0);
  for (int i = 0; i < 2; ++i) {
    spi.write(kDr, 0, now);
    run_until(now + 100);
  }
  spi.read(kSr);
  EXPECT_NE(spi.read(kSr) & kOvr, 0U);
  spi.read(kDr);
  EXPECT_NE(spi.read(kSr) & kOvr, 0U);
  EXPECT_EQ(spi.read(kSr) & kOvr, 0U);
}

TEST_F(SpiBlock, BitLastsTwoToTwoHundredAndFiftySixCyclesOfPclk) {
  for (const unsigned divider : {1U, 2U, 16U})
    for (std::uint32_t br = 0; br < 8; ++br) {
      Spi each;
      each.set_divider(divider);
      each.write(kCr1, kMaster | kEnabled | kSsm | kSsi | br << 3U, 0);
      each.write(kDr, 0, 1000);
      const std::uint64_t load = each.next();
      EXPECT_EQ(load, (1000 / divider + 1) * divider);
      each.run(true);
      const std::uint64_t first = each.next();
      each.run(true);
      each.run(true);
      EXPECT_EQ(first - load, std::uint64_t{divider} << br);
      EXPECT_EQ(each.next() - first, std::uint64_t{2} * divider << br);
    }
}

TEST_F(SpiBlock, OtherModesMoveIdleLevelAndSamplingEdge) {
  constexpr std::uint32_t kCpha = 1, kCpol = 2;
  for (const auto& [mode, idle, rxne] :
       {std::tuple(kCpol, true, 60U), {kCpha, false, 64U}, {kCpha | kCpol, true, 64U}}) {
    Spi each;
    each.write(kCr1, kOn | mode, 0);
    EXPECT_EQ(each.sck(), idle);
    each.write(kDr, 0x80, 100);
    std::uint64_t at = 0, first_bit = 0;
    while ((each.peek(kSr) & kRxne) == 0) {
      at = each.next();
      each.run(true);
      if (each.mosi() && first_bit == 0) first_bit = at;
    }
    EXPECT_EQ(at, 101 + rxne) << mode;
    EXPECT_EQ(first_bit, (mode & kCpha) != 0 ? 105U : 101U);
    while (each.next() != Spi::kNever) each.run(true);
    EXPECT_EQ(each.sck(), idle);
  }
}

TEST_F(SpiBlock, SixteenBitsAndLeastSignificantFirst) {
  answer = 0x01;
  spi.write(kCr1, kOn | kLsbFirst | kSixteen, 0);
  spi.write(kDr, 0x0003, 100);
  run_until(1000);
  EXPECT_EQ(clock.size(), 32U);
  EXPECT_THAT(data, ElementsAre(Edge{101, true}, Edge{117, false}));
  EXPECT_EQ(spi.read(kDr), 0x8080U);
}

TEST_F(SpiBlock, InterruptsAreAskedForByTheirEnables) {
  spi.write(kCr1, kOn, 0);
  EXPECT_FALSE(spi.asks());
  spi.write(kCr2, 0x80, 0);  // TXEIE
  EXPECT_TRUE(spi.asks());
  spi.write(kCr2, 0x40, 0);  // RXNEIE
  EXPECT_FALSE(spi.asks());
  spi.write(kDr, 0, 0);
  EXPECT_EQ(when(kRxne, true, 1000), 61U);
  EXPECT_TRUE(spi.asks());
  spi.read(kDr);
  EXPECT_FALSE(spi.asks());
  spi.write(kCr2, 0x20, 0);  // ERRIE
  for (int i = 0; i < 2; ++i) {
    spi.write(kDr, 0, now);
    run_until(now + 100);
  }
  EXPECT_TRUE(spi.asks());
}

TEST_F(SpiBlock, MasterWhoseNssIsLowFallsBackToSlave) {
  spi.write(kCr1, kMaster | kEnabled | kSsm, 0);  // SSI forgotten
  EXPECT_EQ(spi.read(kSr), kTxe | kModf);
  EXPECT_EQ(spi.peek(kCr1), kSsm);
  spi.write(kDr, 1, 0);
  EXPECT_EQ(spi.next(), Spi::kNever);
  spi.write(kCr1, kOn, 0);  // after SR was read: MODF is cleared, and the buffer is sent
  EXPECT_EQ(spi.read(kSr) & kModf, 0U);
  EXPECT_EQ(spi.next(), 1U);
}

TEST_F(SpiBlock, NssAsAnInputCountsUnlessSsmOrSsoe) {
  spi.write(kCr1, kMaster | kEnabled, 0);
  spi.set_nss(true);
  EXPECT_TRUE(spi.drives());
  spi.set_nss(false);
  EXPECT_FALSE(spi.drives());
  spi.reset();
  spi.write(kCr2, 0x04, 0);
  spi.write(kCr1, kMaster | kEnabled, 0);
  EXPECT_TRUE(spi.drives());
  EXPECT_TRUE(spi.selects());
}

TEST_F(SpiBlock, WhatIsInTheBufferWaitsForTheEnable) {
  spi.write(kDr, 0x80, 50);
  EXPECT_EQ(spi.next(), Spi::kNever);
  spi.write(kCr1, kOn, 200);
  EXPECT_EQ(spi.next(), 201U);
  run_until(230);
  spi.write(kCr1, kOn & ~kEnabled, 230);
  EXPECT_EQ(spi.next(), Spi::kNever);
  EXPECT_FALSE(spi.drives());
  EXPECT_EQ(spi.peek(kSr), kTxe);
}

}  // namespace
}  // namespace dsdpv1::arm
