// USART2 of the ARM board by its registers, cycle by cycle of HCLK: RM0008, chapter USART.
#include "board/stm32/usart.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bitset>
#include <string>
#include <vector>

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kSr = 0x00, kDr = 0x04, kBrr = 0x08, kCr1 = 0x0C, kCr2 = 0x10, kCr3 = 0x14;
constexpr std::uint32_t kRe = 1U << 2U, kTe = 1U << 3U, kOdd = 1U << 9U, kParity = 1U << 10U, kNine = 1U << 12U,
                        kUe = 1U << 13U;
constexpr std::uint32_t kPe = 0x01, kFe = 0x02, kNe = 0x04, kOre = 0x08, kIdle = 0x10, kRxne = 0x20, kTc = 0x40,
                        kTxe = 0x80;
constexpr std::uint64_t kBit = 32;  // BRR
constexpr std::uint32_t kOn = kUe | kTe | kRe | kNine | kParity;

/// Eleven bits, the start bit first.
unsigned frame_of(unsigned value) {
  const bool odd = std::bitset<8>(value).count() % 2 != 0;
  return value << 1U | static_cast<unsigned>(odd) << 9U | 1U << 10U;
}

class UsartBlock : public testing::Test {
 protected:
  void SetUp() override {
    usart.write(kBrr, kBit, 0);
    usart.write(kCr1, kOn, 0);
    run_until(kBegin);
  }
  void run_until(std::uint64_t end) {
    while (usart.next() <= end) {
      now = usart.next();
      usart.run();
      levels.emplace_back(now, usart.tx());
    }
    now = end;
  }
  /// Bit by bit, from cycle `at` on.
  void hear(std::uint64_t at, unsigned bits, unsigned count = 11, std::uint64_t bit = kBit) {
    for (unsigned i = 0; i < count; ++i) {
      const bool level = (bits >> i & 1U) != 0;
      if (level == rx) continue;
      run_until(at + i * bit - 1);
      usart.rx_changed(at + i * bit, level);
      rx = level;
    }
  }
  std::uint64_t when(std::uint32_t flag, std::uint64_t end) {
    while ((usart.peek(kSr) & flag) == 0) {
      if (usart.next() > end) return 0;
      run_until(usart.next());
    }
    return now;
  }
  /// As a program clears them: SR, then DR.
  std::uint32_t fetch() {
    flags = usart.read(kSr);
    return usart.read(kDr);
  }
  static constexpr std::uint64_t kBegin = 1000;
  Usart usart;
  std::uint64_t now = 0;
  std::uint32_t flags = 0;
  bool rx = true;
  std::vector<std::pair<std::uint64_t, bool>> levels;  ///< TX after each action
};

// -------------------------------------------------------------------------------------------------------- transmitter

TEST_F(UsartBlock, CharacterHasElevenBitsWithEvenParity) {
  levels.clear();
  usart.write(kDr, 0x31, kBegin);  // three ones
  run_until(5000);
  ASSERT_EQ(levels.size(), 12U);
  for (unsigned i = 0; i < 11; ++i) {
    EXPECT_EQ(levels[i].first, kBegin + 1 + i * kBit);
    EXPECT_EQ(levels[i].second, (frame_of(0x31) >> i & 1U) != 0) << i;
  }
  EXPECT_EQ(levels[11].first, kBegin + 1 + 11 * kBit);
}

TEST_F(UsartBlock, TxeRisesWithTheStartBitAndTcWithTheEnd) {
  usart.read(kSr);
  usart.write(kDr, 0, kBegin);
  EXPECT_EQ(usart.peek(kSr) & (kTxe | kTc), 0U);
  EXPECT_EQ(when(kTxe, 5000), kBegin + 1);
  EXPECT_EQ(when(kTc, 5000), kBegin + 1 + 11 * kBit);
}

TEST_F(UsartBlock, TcStandsWhenSrIsNotReadBeforeTheWrite) {
  usart.write(kDr, 0, kBegin);
  EXPECT_NE(usart.peek(kSr) & kTc, 0U);
  usart.write(kSr, ~kTc, kBegin);
  EXPECT_EQ(usart.peek(kSr) & kTc, 0U);
}

TEST_F(UsartBlock, SecondCharacterFollowsWithoutAGap) {
  usart.read(kSr);
  usart.write(kDr, 0, kBegin);
  run_until(kBegin + 10);
  usart.write(kDr, 0xFF, kBegin + 10);
  EXPECT_EQ(when(kTxe, 5000), kBegin + 1 + 11 * kBit);
  EXPECT_EQ(when(kTc, 5000), kBegin + 1 + 22 * kBit);
}

TEST_F(UsartBlock, TransmitterBeginsWithAnIdleFrame) {
  Usart fresh;
  fresh.set_divider(2);
  fresh.write(kBrr, 20, 0);
  fresh.write(kDr, 0x55, 0);
  fresh.write(kCr1, kOn, 99);
  EXPECT_EQ(fresh.next(), 100 + 11 * 40U);
}

TEST_F(UsartBlock, WordsOf8BitsWithoutParityAndTwoStopBits) {
  usart.write(kCr1, kUe | kTe | kRe, kBegin);
  usart.write(kCr2, 2U << 12U, kBegin);
  usart.read(kSr);
  usart.write(kDr, 0x1FF, kBegin);
  EXPECT_EQ(when(kTc, 5000), kBegin + 1 + 11 * kBit);
  usart.write(kCr2, 0, now);
  usart.read(kSr);
  usart.write(kDr, 0x00, now);
  const std::uint64_t begin = now + 1;
  EXPECT_EQ(when(kTc, 5000), begin + 10 * kBit);
}

// ----------------------------------------------------------------------------------------------------------- receiver

TEST_F(UsartBlock, RxneRisesWithTheStopBitsLastSample) {
  hear(2000, frame_of(0xC4));
  EXPECT_EQ(when(kRxne, 5000), 2000 + (16 * 10 + 10) * kBit / 16);
  EXPECT_EQ(fetch() & 0xFFU, 0xC4U);
  EXPECT_EQ(flags, kTxe | kTc | kRxne);
  EXPECT_EQ(usart.peek(kSr) & kRxne, 0U);
}

TEST_F(UsartBlock, ReceiverBeginsWithTheFirstCycleOfPclkThatSeesTheFall) {
  for (const std::uint64_t fall : {2012U, 2013U, 2016U}) {
    Usart each;
    each.set_divider(4);
    each.write(kBrr, 16, 0);
    each.write(kCr1, kOn, 0);
    each.rx_changed(fall, false);
    EXPECT_EQ(each.next(), (fall == 2012 ? 2012U : 2016U) + 40) << fall;  // the start bit's tenth sample
  }
}

TEST_F(UsartBlock, NinthBitOfDrIsTheParity) {
  hear(2000, frame_of(0x01));
  run_until(3000);
  EXPECT_EQ(fetch(), 0x101U);
}

TEST_F(UsartBlock, CharacterThatFindsRxneIsLostAndTheFirstOneKept) {
  hear(2000, frame_of(0x11));
  hear(2000 + 11 * kBit, frame_of(0x22));
  EXPECT_EQ(when(kOre, 5000), 2000 + 11 * kBit + (16 * 10 + 10) * kBit / 16);
  EXPECT_EQ(usart.lost(), 1U);
  EXPECT_EQ(fetch() & 0xFFU, 0x11U);
  EXPECT_EQ(usart.peek(kSr) & (kOre | kRxne), 0U);
  hear(4000, frame_of(0x33));
  run_until(5000);
  EXPECT_EQ(fetch() & 0xFFU, 0x33U);
}

TEST_F(UsartBlock, OreStandsWhenSrIsNotReadBeforeDr) {
  hear(2000, frame_of(0x11));
  hear(2000 + 11 * kBit, frame_of(0x22));
  run_until(5000);
  usart.read(kDr);
  EXPECT_EQ(usart.peek(kSr) & (kOre | kRxne), kOre);
}

TEST_F(UsartBlock, WrongParityAndStopBitAreTold) {
  hear(2000, frame_of(0x11) ^ 1U << 9U);
  run_until(3000);
  EXPECT_EQ(fetch() & 0xFFU, 0x11U);
  EXPECT_EQ(flags & (kPe | kFe | kNe), kPe);
  hear(3000, frame_of(0x11) & 0x3FFU, 12);
  hear(3000 + 12 * kBit, 1, 1);
  run_until(4000);
  fetch();
  EXPECT_EQ(flags & (kPe | kFe | kNe), kFe);
  EXPECT_EQ(usart.peek(kSr) & kFe, 0U);
}

TEST_F(UsartBlock, OddParityWhenPsSaysSo) {
  usart.write(kCr1, kOn | kOdd, kBegin);
  hear(2000, frame_of(0x11) ^ 1U << 9U);
  run_until(3000);
  fetch();
  EXPECT_EQ(flags & kPe, 0U);
}

TEST_F(UsartBlock, EdgeAmongTheThreeSamplesIsNoise) {
  hear(2000, 0, 1);
  run_until(2000 + 16 + kBit + 3);
  usart.rx_changed(2000 + 16 + kBit + 4, true);  // the tenth sample of the first data bit is at 2000 + kBit + 20
  rx = true;
  run_until(3000);
  fetch();
  EXPECT_EQ(flags & kNe, kNe);
}

TEST_F(UsartBlock, PulseThatIsNoStartBitIsIgnored) {
  hear(2000, 0, 1);
  usart.rx_changed(2000 + 10, true);
  rx = true;
  run_until(4000);
  EXPECT_EQ(usart.peek(kSr), kTxe | kTc);
  hear(4000, frame_of(0x77));
  run_until(5000);
  EXPECT_EQ(fetch() & 0xFFU, 0x77U);
}

TEST_F(UsartBlock, IdleComesAFrameAfterTheLastCharacterAndOnce) {
  hear(2000, frame_of(0x11));
  EXPECT_EQ(when(kIdle, 9000), 2000 + 22 * kBit);
  fetch();
  EXPECT_EQ(usart.peek(kSr) & kIdle, 0U);
  run_until(20'000);
  EXPECT_EQ(usart.peek(kSr) & kIdle, 0U);
}

TEST_F(UsartBlock, NextCharacterKeepsIdleAway) {
  hear(2000, frame_of(0x11));
  run_until(2000 + 12 * kBit);
  fetch();
  hear(2000 + 21 * kBit, frame_of(0x22));
  run_until(2000 + 31 * kBit);
  EXPECT_EQ(usart.peek(kSr) & kIdle, 0U);
}

/// 1.8432 Mbit/s of the chip against 36 MHz / 20 (-2.4 %): the rates in the board's firmware.
TEST_F(UsartBlock, SenderThreePercentFasterIsUnderstood) {
  for (unsigned value = 0; value < 256; ++value) {
    const std::uint64_t at = 2000 + 1000 * value;
    hear(at, frame_of(value), 11, 31);
    run_until(at + 900);
    EXPECT_EQ(fetch() & 0xFFU, value);
    EXPECT_EQ(flags & (kPe | kFe), 0U);
  }
}

TEST_F(UsartBlock, DeafWithoutRe) {
  usart.write(kCr1, kOn & ~kRe, kBegin);
  hear(2000, frame_of(0x11));
  run_until(4000);
  EXPECT_EQ(usart.peek(kSr) & kRxne, 0U);
  usart.write(kCr1, kOn, 4000);
  hear(5000, frame_of(0x22));
  run_until(6000);
  EXPECT_EQ(fetch() & 0xFFU, 0x22U);
}

TEST_F(UsartBlock, InterruptsAreAskedForByTheirEnables) {
  const auto asks = [this](std::uint32_t enable) {
    usart.write(kCr1, kOn | enable, now);
    return usart.asks();
  };
  EXPECT_FALSE(asks(0));
  EXPECT_TRUE(asks(1U << 7U));  // TXEIE
  EXPECT_TRUE(asks(1U << 6U));  // TCIE
  EXPECT_FALSE(asks(1U << 5U));
  hear(2000, frame_of(0x11) ^ 1U << 9U);
  run_until(2000 + 30 * kBit);
  EXPECT_TRUE(asks(1U << 5U));  // RXNEIE
  EXPECT_TRUE(asks(1U << 8U));  // PEIE
  EXPECT_TRUE(asks(1U << 4U));  // IDLEIE
  fetch();
  EXPECT_FALSE(asks(1U << 5U | 1U << 8U | 1U << 4U));
}

TEST_F(UsartBlock, RtsIsHighWhileACharacterWaits) {
  usart.write(kCr3, 1U << 8U, kBegin);
  EXPECT_TRUE(usart.drives_rts());
  EXPECT_FALSE(usart.rts());
  hear(2000, frame_of(0x11));
  run_until(3000);
  EXPECT_TRUE(usart.rts());
  fetch();
  EXPECT_FALSE(usart.rts());
}

}  // namespace
}  // namespace dsdpv1::arm
