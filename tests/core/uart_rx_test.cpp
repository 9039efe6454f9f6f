// Rulings S2, S10; chapter 6 of the micro-architecture.
#include "model/profibus/uart_rx.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace profibus {
namespace {

/// The levels of one character, bit by bit.
std::vector<bool> bits_of(std::uint8_t byte, bool good_parity = true, bool good_stop = true) {
  std::vector<bool> bits = {false};
  bool parity = false;
  for (unsigned i = 0; i < 8; ++i) {
    bits.push_back((byte >> i & 1) != 0);
    parity ^= bits.back();
  }
  bits.push_back(parity == good_parity);
  bits.push_back(good_stop);
  return bits;
}

struct Received {
  Cycle at = 0;
  Character character;
};

/// The logic sees `level` at the edge of `now`: the pin changed three edges before it (P9).
void see(UartRx& rx, Cycle now, bool level) { rx.set_line((now - 3) * kTicksPerCycle, level); }

/// Runs a receiver over a line given cycle by cycle.
std::vector<Received> receive(const std::vector<bool>& line, int bit) {
  UartRx rx;
  rx.restart(bit, 0, 0);
  std::vector<Received> found;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const auto now = static_cast<Cycle>(i);
    see(rx, now, line[i]);
    if (rx.eval(now)) found.push_back({now, rx.character()});
  }
  return found;
}

void append(std::vector<bool>& line, const std::vector<bool>& bits, int bit) {
  for (const bool level : bits) line.insert(line.end(), static_cast<std::size_t>(bit), level);
}

TEST(UartRxBlock, EveryByteAtEveryRateIsCompleteInTheMiddleOfItsStopBit) {
  for (const int bit : kBitCycles) {
    for (int byte = 0; byte<256; byte += bit> 100 ? 37 : 1) {
      std::vector<bool> line(100, true);
      append(line, bits_of(static_cast<std::uint8_t>(byte)), bit);
      line.insert(line.end(), 10, true);
      const std::vector<Received> found = receive(line, bit);
      ASSERT_EQ(found.size(), 1U);
      EXPECT_EQ(found[0].at, 100 + bit / 2 + 10 * bit);
      EXPECT_EQ(found[0].character.start, 100);
      EXPECT_EQ(found[0].character.idle, 100);
      EXPECT_EQ(found[0].character.value, byte);
      EXPECT_TRUE(found[0].character.parity_ok && found[0].character.stop_ok);
    }
  }
}

TEST(UartRxBlock, ParityAndStopFaultsAreTold) {
  for (int byte = 0; byte < 256; ++byte) {
    std::vector<bool> line(50, true);
    append(line, bits_of(static_cast<std::uint8_t>(byte), false), 4);
    line.insert(line.end(), 50, true);
    append(line, bits_of(static_cast<std::uint8_t>(byte), true, false), 4);
    line.insert(line.end(), 50, true);
    const std::vector<Received> found = receive(line, 4);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_FALSE(found[0].character.parity_ok);
    EXPECT_TRUE(found[0].character.stop_ok);
    EXPECT_TRUE(found[1].character.parity_ok);
    EXPECT_FALSE(found[1].character.stop_ok);
  }
}

TEST(UartRxBlock, IdleIsCountedFromTheCalculatedEndAndGlitchesDoNotEndIt) {
  std::vector<bool> line(40, true);
  append(line, bits_of(0x5A), 16);
  line.insert(line.end(), 100, true);
  line.insert(line.end(), 8, false);  // high again at mid-bit (8 cycles after the edge): no start
  line.insert(line.end(), 100, true);
  append(line, bits_of(0x5A), 16);
  line.insert(line.end(), 20, true);
  const std::vector<Received> found = receive(line, 16);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[1].character.idle, 208);
}

TEST(UartRxBlock, ALowPulseOneCycleLongerThanHalfABitIsAStart) {
  std::vector<bool> line(40, true);
  line.insert(line.end(), 9, false);
  line.insert(line.end(), 400, true);
  const std::vector<Received> found = receive(line, 16);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].character.value, 0xFF);
}

TEST(UartRxBlock, BackToBackCharactersHaveNoIdle) {
  std::vector<bool> line(40, true);
  for (int i = 0; i < 5; ++i) append(line, bits_of(static_cast<std::uint8_t>(i * 51)), 4);
  line.insert(line.end(), 20, true);
  const std::vector<Received> found = receive(line, 4);
  ASSERT_EQ(found.size(), 5U);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_EQ(found[i].character.idle, 0);
}

TEST(UartRxBlock, AfterABreakIdleCountsFromTheRise) {
  std::vector<bool> line(40, true);
  line.insert(line.end(), 200, false);
  line.insert(line.end(), 70, true);
  append(line, bits_of(0x33), 4);
  line.insert(line.end(), 20, true);
  const std::vector<Received> found = receive(line, 4);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_FALSE(found[0].character.stop_ok);
  EXPECT_EQ(found[1].character.idle, 70);
}

TEST(UartRxBlock, EvaluatedOnlyAtNextAndAtEdgesItIsTheSame) {
  std::mt19937 random(8);
  for (const int bit : {4, 8, 16, 96}) {
    std::vector<bool> line(30, true);
    while (line.size() < 60'000) {
      switch (random() % 4) {
        case 0: line.insert(line.end(), random() % 300, true); break;
        case 1: line.insert(line.end(), random() % static_cast<unsigned>(bit), false); break;
        case 2:
          append(line, bits_of(static_cast<std::uint8_t>(random()), random() % 8 != 0, random() % 8 != 0), bit);
          break;
        default: line.insert(line.end(), random() % 40, random() % 2 == 0); break;
      }
    }
    UartRx every, sparse;
    every.restart(bit, 0, 0);
    sparse.restart(bit, 0, 0);
    int complete = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const auto now = static_cast<Cycle>(i);
      if (sparse.full()) ASSERT_FALSE(sparse.eval(now - 1));
      see(every, now, line[i]);
      see(sparse, now, line[i]);
      const bool done = every.eval(now);
      const bool sparse_done = now >= sparse.next() && sparse.eval(now);
      ASSERT_EQ(done, sparse_done) << "cycle " << now;
      ASSERT_EQ(every.receiving(now), sparse.receiving(now)) << "cycle " << now;
      if (!done) continue;
      ++complete;
      ASSERT_EQ(every.character().value, sparse.character().value);
      ASSERT_EQ(every.character().idle, sparse.character().idle);
      ASSERT_EQ(every.character().start, sparse.character().start);
    }
    EXPECT_GT(complete, 10);
  }
}

}  // namespace
}  // namespace profibus
