#include "bus/wire/uart.hpp"

#include <gtest/gtest.h>

#include "bus/timeline.hpp"

namespace dsdpv1::bus {
namespace {

/// A sender and a receiver on one wire.
struct Wire : Listener, Agent {
  explicit Wire(int index = 0, std::int64_t ppm = 0)
      : bit(baud(index).bit), sender(segment, segment.attach("wire", this)) {
    sender.set_timing(bit, ppm);
    receiver.set_bit(bit);
    receiver.on_character = [this](const ReceivedCharacter& character) { got.push_back(character); };
    receiver.on_false_start = [this](Tick at) { false_starts.push_back(at); };
    timeline.add(*this);
  }
  void line_changed(Tick at, bool level) override {
    edges.push_back(at);
    if (receiver.line_changed(at, level)) announce();
  }
  Tick next() const override { return std::min(sender.next(), receiver.next()); }
  void run(Tick now) override {
    sender.run(now);
    receiver.run(now);
  }
  void send(const std::vector<Character>& what, Tick start = 1000) {
    sender.send(start, what);
    announce();
    timeline.run_until(sender.end() + 20 * bit);
  }
  Bytes bytes() const {
    Bytes result;
    for (const ReceivedCharacter& character : got) result.push_back(character.byte);
    return result;
  }

  Tick bit;
  Segment segment;
  UartSender sender;
  UartReceiver receiver;
  Timeline timeline;
  std::vector<ReceivedCharacter> got;
  std::vector<Tick> false_starts, edges;
};

Bytes all_bytes() {
  Bytes bytes;
  for (int i = 0; i < 256; ++i) bytes.push_back(static_cast<std::uint8_t>(i));
  return bytes;
}

TEST(UartCharacter, ParityIsEven) {
  EXPECT_FALSE(even_parity(0x00));
  EXPECT_TRUE(even_parity(0x01));
  EXPECT_FALSE(even_parity(0x03));
  EXPECT_TRUE(even_parity(0x80));
  EXPECT_FALSE(even_parity(0xFF));
}

class UartAtEveryBaud : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Bauds, UartAtEveryBaud, testing::Range(0, kBaudCount));

TEST_P(UartAtEveryBaud, EveryByteArrivesWithItsTimes) {
  Wire wire(GetParam());
  wire.send(characters(all_bytes()));
  EXPECT_EQ(wire.bytes(), all_bytes());
  for (std::size_t i = 0; i < wire.got.size(); ++i) {
    EXPECT_TRUE(wire.got[i].ok());
    EXPECT_EQ(wire.got[i].start, 1000 + static_cast<Tick>(i) * 11 * wire.bit);
    EXPECT_EQ(wire.got[i].end, wire.got[i].start + 11 * wire.bit);
  }
  EXPECT_EQ(wire.sender.end(), 1000 + 256 * 11 * wire.bit);
}

TEST_P(UartAtEveryBaud, AClockErrorOfFourPercentIsTolerated) {
  for (const int ppm : {-40'000, 40'000}) {
    Wire wire(GetParam(), ppm);
    wire.send(characters(all_bytes()));
    EXPECT_EQ(wire.bytes(), all_bytes());
    for (const ReceivedCharacter& character : wire.got) EXPECT_TRUE(character.ok());
  }
}

TEST_P(UartAtEveryBaud, AClockErrorOfSixPercentIsNot) {
  for (const int ppm : {-60'000, 60'000}) {
    Wire wire(GetParam(), ppm);
    wire.send(characters({0x55, 0x00, 0xFF}));
    bool wrong = wire.got.size() != 3;
    for (const ReceivedCharacter& character : wire.got) wrong = wrong || !character.ok();
    EXPECT_TRUE(wrong) << ppm;
  }
}

TEST(UartSender, EdgesDoNotDrift) {
  Wire wire(9, 100);  // 1250125 ticks a bit
  wire.send(characters(Bytes(200, 0x55)), 0);
  EXPECT_EQ(wire.sender.end(), 200LL * 11 * 1'250'125);
}

TEST(UartSender, EdgesAreRoundedFromTheExactTime) {
  Wire wire(0, 333);  // 1000.333 ticks a bit
  wire.send(characters(Bytes(3, 0x55)), 0);
  EXPECT_EQ(wire.sender.end(), 33011);  // 33 bits = 33010.989
}

TEST(UartSender, DriverLeadsAndTrails) {
  Wire wire;
  std::vector<Collision> collisions;
  wire.segment.on_collision = [&](const Collision& c) { collisions.push_back(c); };
  const StationId other = wire.segment.attach("other", nullptr);
  wire.segment.drive(other, 0, true, true);
  wire.sender.set_driver_times(250, 500);
  wire.sender.send(5000, characters({0x00}));
  EXPECT_EQ(wire.sender.next(), 4750);
  wire.timeline.run_until(4750);
  ASSERT_EQ(collisions.size(), 1U);
  EXPECT_EQ(collisions[0].at, 4750);
  wire.timeline.run_until(wire.sender.end());
  EXPECT_EQ(wire.sender.end(), 5000 + 11 * 1000);
  EXPECT_TRUE(wire.sender.busy());
  EXPECT_EQ(wire.sender.next(), wire.sender.end() + 500);
}

TEST(UartSender, AbortReleasesTheLine) {
  Wire wire;
  wire.sender.send(1000, characters({0x00, 0x00}));
  wire.timeline.run_until(5000);
  EXPECT_FALSE(wire.segment.level());
  wire.sender.abort(5100);
  EXPECT_TRUE(wire.segment.level());
  EXPECT_FALSE(wire.sender.busy());
  EXPECT_EQ(wire.sender.next(), kNever);
}

TEST(UartReceiver, WrongParityIsReported) {
  Wire wire;
  wire.send({Character::wrong_parity(0x5A)});
  ASSERT_EQ(wire.got.size(), 1U);
  EXPECT_EQ(wire.got[0].byte, 0x5A);
  EXPECT_FALSE(wire.got[0].parity_ok);
  EXPECT_TRUE(wire.got[0].stop_ok);
}

TEST(UartReceiver, ALowStopBitIsReportedAndTheNextCharacterAfterAPauseIsRight) {
  Wire wire;
  Character second = Character::of(0x33);
  second.gap_millibits = 12'000;
  wire.send({Character::without_stop(0x5A), second});
  ASSERT_EQ(wire.got.size(), 2U);
  EXPECT_FALSE(wire.got[0].stop_ok);
  EXPECT_TRUE(wire.got[0].parity_ok);
  EXPECT_EQ(wire.got[1].byte, 0x33);
  EXPECT_TRUE(wire.got[1].ok());
}

TEST(UartReceiver, AGapDelaysTheNextStart) {
  Wire wire;
  WireFaults faults;
  faults.gap_before = 1;
  faults.gap_millibits = 2500;
  wire.send(characters({1, 2}, faults));
  ASSERT_EQ(wire.got.size(), 2U);
  EXPECT_EQ(wire.got[1].start - wire.got[0].end, 2500);
}

TEST(UartReceiver, GlitchesShorterThanHalfABitDoNoHarm) {
  for (int start = 0; start < 11'000; start += 1000) {
    Wire wire;
    WireFaults faults;
    faults.glitch_at = 0;
    faults.glitch = {start + 20, 450};
    wire.send(characters({0x6C}, faults));
    ASSERT_EQ(wire.bytes(), Bytes{0x6C}) << start;
    EXPECT_TRUE(wire.got[0].ok()) << start;
  }
}

TEST(UartReceiver, AGlitchOverTheSamplingPointDestroysTheCharacter) {
  Wire wire;
  WireFaults faults;
  faults.glitch_at = 0;
  faults.glitch = {3400, 200};
  wire.send(characters({0x6C}, faults));
  ASSERT_EQ(wire.got.size(), 1U);
  EXPECT_FALSE(wire.got[0].parity_ok);
}

TEST(UartReceiver, AShortLowPulseIsNoStartBit) {
  Wire wire;
  wire.segment.force(3000, false);
  wire.segment.force(3400, std::nullopt);
  wire.timeline.run_until(20'000);
  EXPECT_TRUE(wire.got.empty());
  EXPECT_EQ(wire.false_starts, std::vector<Tick>{3000});
}

TEST(UartReceiver, ATruncatedCharacterEndsInIdleBits) {
  Wire wire;
  WireFaults faults;
  faults.truncate_after = 1;
  faults.truncate_bits = 4;
  wire.send(characters({0x00, 0x00, 0x00}, faults));
  ASSERT_EQ(wire.got.size(), 2U);
  EXPECT_EQ(wire.got[1].byte, 0xF8);
  EXPECT_EQ(wire.sender.end(), 1000 + 15 * 1000);
}

TEST(UartReceiver, RawPatternsAreSentAsTheyAre) {
  Wire wire;
  Character low;
  low.bits = 0;
  low.bit_count = 16;
  wire.send({low});
  ASSERT_FALSE(wire.got.empty());
  EXPECT_EQ(wire.got[0].byte, 0);
  EXPECT_FALSE(wire.got[0].stop_ok);
  EXPECT_EQ(wire.edges, (std::vector<Tick>{1000, 17'000}));
}

}  // namespace
}  // namespace dsdpv1::bus
