#include "bus/capture/collector.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dsdpv1::bus::capture {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

struct CollectorTest : testing::Test {
  static WireTelegram telegram(Tick start, DecodeError error = DecodeError::kNone) {
    WireTelegram wire;
    wire.start = start;
    wire.end = start + 33'000;
    wire.decoded.error = error;
    wire.decoded.bytes = {0xDC, 2, 2};
    return wire;
  }
  std::vector<CapturedTelegram> taken;
  Collector collector{[this](const CapturedTelegram& each) { taken.push_back(each); }};
};

TEST_F(CollectorTest, TelegramIsTakenWhenTheNextOneIsThere) {
  collector.telegram(telegram(0));
  EXPECT_THAT(taken, IsEmpty());
  collector.telegram(telegram(100'000));
  EXPECT_THAT(taken, SizeIs(1));
  collector.finish();
  ASSERT_THAT(taken, SizeIs(2));
  EXPECT_EQ(taken[1].start, 100'000);
}

TEST_F(CollectorTest, FlagsGoToTheTelegramOfTheirTime) {
  collector.flagged({FlagKind::kCollision, 5, "a drives while b does"});
  collector.telegram(telegram(0));
  collector.flagged({FlagKind::kSynViolated, 100'000, "early"});
  collector.telegram(telegram(100'000));
  collector.finish();
  EXPECT_THAT(taken[0].remarks, ElementsAre("collision: a drives while b does"));
  EXPECT_EQ(taken[0].damage, damage::kCharacter);
  EXPECT_THAT(taken[1].remarks, ElementsAre("T_SYN violated: early"));
  EXPECT_EQ(taken[1].damage, damage::kGap);
}

TEST_F(CollectorTest, UnansweredIsSaidOfTheRequest) {
  collector.telegram(telegram(0));
  collector.flagged({FlagKind::kUnanswered, 1'000'000, "station 5 did not answer"});
  collector.telegram(telegram(1'100'000));
  collector.finish();
  EXPECT_THAT(taken[0].remarks, ElementsAre("unanswered: station 5 did not answer"));
  EXPECT_EQ(taken[0].damage, 0U);
  EXPECT_THAT(taken[1].remarks, IsEmpty());
}

TEST_F(CollectorTest, EveryErrorIsADamage) {
  for (const DecodeError error : {DecodeError::kStartDelimiter, DecodeError::kLengthRange, DecodeError::kLengthMismatch,
                                  DecodeError::kSecondStartDelimiter, DecodeError::kFcs, DecodeError::kEndDelimiter,
                                  DecodeError::kMissingSap, DecodeError::kTruncated}) {
    collector.telegram(telegram(0, error));
    collector.finish();
    EXPECT_NE(taken.back().damage, 0U) << describe(error);
    EXPECT_NE(damage_words(taken.back().damage), "") << describe(error);
  }
}

TEST_F(CollectorTest, CharactersAfterAWrongTelegramAreItsOwn) {
  collector.telegram(telegram(0, DecodeError::kStartDelimiter));
  collector.skipped({0x55, 33'000, 44'000}, 0);
  collector.skipped({0x66, 44'000, 55'000}, 0);
  collector.finish();
  EXPECT_EQ(taken[0].bytes, (Bytes{0xDC, 2, 2, 0x55, 0x66}));
  EXPECT_EQ(taken[0].end, 55'000);
}

TEST_F(CollectorTest, NoiseWithoutAnEndIsSeveralTelegrams) {
  for (int i = 0; i < 3 * static_cast<int>(Collector::kMostBytes); ++i)
    collector.skipped({0x55, i * 11'000, (i + 1) * 11'000}, 0);
  collector.finish();
  ASSERT_THAT(taken, SizeIs(3));
  EXPECT_EQ(taken[2].start, 2 * static_cast<Tick>(Collector::kMostBytes) * 11'000);
}

TEST_F(CollectorTest, FlagsWithoutATelegramAreNotKeptForEver) {
  for (int i = 0; i < 1000; ++i) collector.flagged({FlagKind::kGlitch, i, "low"});
  collector.telegram(telegram(2000));
  collector.finish();
  EXPECT_THAT(taken[0].remarks, SizeIs(Collector::kMostRemarks));
}

}  // namespace
}  // namespace dsdpv1::bus::capture
