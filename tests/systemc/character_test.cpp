#include <gtest/gtest.h>

#include "model/systemc/character_line.hpp"
#include "tests/systemc/bench.hpp"

namespace dsdpv1 {

using dsdpv1::systemc::CharacterCollector;
using dsdpv1::systemc::EdgeQueue;
using dsdpv1::systemc::frame_of;

void simulate() {}

namespace {

TEST(Character, FrameHasStartDataEvenParityAndStop) {
  EXPECT_EQ(frame_of(0x00, true, true), 0b1'0'00000000'0);
  EXPECT_EQ(frame_of(0x01, true, true), 0b1'1'00000001'0);
  EXPECT_EQ(frame_of(0xFF, true, true), 0b1'0'11111111'0);
  EXPECT_EQ(frame_of(0x16, false, true), 0b1'0'00010110'0);
  EXPECT_EQ(frame_of(0xE5, true, false), 0b0'1'11100101'0);
}

/// Passes a frame's edges to a collector.
void feed(CharacterCollector& collector, Tick start, Tick bit, std::uint16_t frame) {
  bool level = true;
  for (int i = 0; i < 11; ++i) {
    const bool next = (frame >> i & 1) != 0;
    if (next != level) collector.edge(start + i * bit, next, bit);
    level = next;
  }
  if (!level) collector.edge(start + 11 * bit, true, bit);
}

TEST(Character, CollectorReturnsEveryByteWithParityAndStopAtItsEnd) {
  for (const bool parity : {true, false}) {
    for (int data = 0; data < 256; ++data) {
      CharacterCollector collector;
      feed(collector, 5000, 1000, frame_of(static_cast<std::uint8_t>(data), parity, true));
      ASSERT_EQ(collector.next(), 16'000);
      EXPECT_FALSE(collector.take(15'999).has_value());
      const auto character = collector.take(16'000);
      ASSERT_TRUE(character.has_value());
      EXPECT_EQ(character->data, data);
      EXPECT_EQ(character->start, 5000);
      EXPECT_EQ(character->bit, 1000);
      EXPECT_EQ(character->parity_ok, parity);
      EXPECT_TRUE(character->stop_ok);
      EXPECT_EQ(collector.next(), profibus::kNever);
    }
  }
}

TEST(Character, CollectorSeesAMissingStopBit) {
  CharacterCollector collector;
  feed(collector, 0, 1000, frame_of(0x55, true, false));
  const auto character = collector.take(11'000);
  ASSERT_TRUE(character.has_value());
  EXPECT_FALSE(character->stop_ok);
  EXPECT_EQ(character->data, 0x55);
}

TEST(Character, CollectorTakesCharactersWithoutAPauseBetweenThem) {
  CharacterCollector collector;
  feed(collector, 0, 1000, frame_of(0x10, true, true));
  EXPECT_EQ(collector.take(11'000)->data, 0x10);
  feed(collector, 11'000, 1000, frame_of(0x02, true, true));
  EXPECT_EQ(collector.take(22'000)->data, 0x02);
}

TEST(EdgeQueue, TheLaterCallerWinsFromItsOwnTickOn) {
  EdgeQueue queue;
  queue.push({100, false});
  queue.push({200, true});
  queue.push({300, false});
  queue.push({200, false});
  EXPECT_EQ(queue.next(), 100);
  EXPECT_FALSE(queue.take().level);
  EXPECT_EQ(queue.next(), 200);
  EXPECT_FALSE(queue.take().level);
  EXPECT_EQ(queue.next(), profibus::kNever);
}

}  // namespace
}  // namespace dsdpv1
