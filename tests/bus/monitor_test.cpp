#include "bus/monitor/monitor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bus/master/requester.hpp"
#include "tests/bus/fake_slave.hpp"

namespace dsdpv1::bus {
namespace {

using test::FakeStation;
using test::Reply;
using testing::HasSubstr;

const Telegram kStatusRequest = make_telegram(3, 1, 0x49);
const Telegram kStatusAnswer = make_telegram(1, 3, 0x00);

struct MonitorTest : testing::Test {
  MonitorTest() : slave(segment, timeline), requester(segment), monitor(segment) {
    timeline.add(requester);
    timeline.add(monitor);
    monitor.on_telegram = [this](const WireTelegram& telegram) { telegrams.push_back(telegram); };
    monitor.on_flag = [this](const Flag& flag) { flags.push_back(flag); };
    answer_with(encode(kStatusAnswer));
  }
  void set_baud(int index) {
    slave.set_baud(index);
    requester.set_baud(index);
    monitor.set_baud(index);
  }
  void answer_with(const Bytes& bytes, int tsdr_millibits = 11'000, const WireFaults& faults = {}) {
    slave.script = [=](const Telegram& telegram) -> std::optional<Reply> {
      if (!telegram.wants_answer() || telegram.da != 3) return std::nullopt;
      return Reply{bytes, tsdr_millibits, faults};
    };
  }
  void send(const Telegram& telegram, const ExchangeOptions& options = {}) {
    requester.send(timeline, telegram, options);
  }
  /// Long enough for every deadline of the monitor.
  void settle() { timeline.run_until(timeline.now() + 2000 * requester.bit()); }
  std::vector<FlagKind> kinds() const {
    std::vector<FlagKind> result;
    for (const Flag& flag : flags) result.push_back(flag.kind);
    return result;
  }
  using Kinds = std::vector<FlagKind>;

  Segment segment;
  Timeline timeline;
  FakeStation slave;
  Requester requester;
  Monitor monitor;
  std::vector<WireTelegram> telegrams;
  std::vector<Flag> flags;
};

class MonitorAtEveryBaud : public MonitorTest, public testing::WithParamInterface<int> {};
INSTANTIATE_TEST_SUITE_P(Bauds, MonitorAtEveryBaud, testing::Range(0, kBaudCount));

TEST_P(MonitorAtEveryBaud, ReportsEveryTelegramWithItsTimesAndFlagsNothing) {
  set_baud(GetParam());
  answer_with(encode(kStatusAnswer), 11'250);
  send(kStatusRequest);
  send(kStatusRequest);
  settle();
  ASSERT_EQ(telegrams.size(), 4U);
  EXPECT_TRUE(flags.empty()) << format_line(flags.front());
  const Tick bit = requester.bit();
  EXPECT_EQ(telegrams[0].end - telegrams[0].start, 66 * bit);
  EXPECT_FALSE(telegrams[0].tsdr.has_value());
  ASSERT_TRUE(telegrams[1].tsdr.has_value());
  EXPECT_EQ(*telegrams[1].tsdr, bit * 45 / 4);
  EXPECT_DOUBLE_EQ(telegrams[1].tsdr_bits(), 11.25);
  EXPECT_EQ(telegrams[1].station, 3);
  EXPECT_EQ(telegrams[1].baud, GetParam());
  EXPECT_EQ(telegrams[1].decoded.telegram, kStatusAnswer);
}

TEST_P(MonitorAtEveryBaud, TsdrLimitsAreThoseOfTheRate) {
  set_baud(GetParam());
  const int max_bits = baud(GetParam()).max_tsdr_bits;
  answer_with(encode(kStatusAnswer), max_bits * 1000);
  send(kStatusRequest);
  settle();
  EXPECT_TRUE(flags.empty());
  answer_with(encode(kStatusAnswer), max_bits * 1000 + 10);
  send(kStatusRequest);
  settle();
  EXPECT_EQ(kinds(), Kinds{FlagKind::kTsdrLate});
  answer_with(encode(kStatusAnswer), 10'990);
  send(kStatusRequest);
  settle();
  EXPECT_EQ(kinds(), (Kinds{FlagKind::kTsdrLate, FlagKind::kTsdrEarly}));
}

TEST_F(MonitorTest, TsdrLimitsCanBeGivenForOneStation) {
  monitor.set_limits(3, {20, 30});
  answer_with(encode(kStatusAnswer), 19'000);
  send(kStatusRequest);
  answer_with(encode(kStatusAnswer), 31'000);
  send(kStatusRequest);
  EXPECT_EQ(kinds(), (Kinds{FlagKind::kTsdrEarly, FlagKind::kTsdrLate}));
  monitor.set_limits(3, {});
  send(kStatusRequest);
  EXPECT_EQ(flags.size(), 2U);
}

TEST_F(MonitorTest, AShortAcknowledgeIsTheAnswerOfTheStationAsked) {
  answer_with(encode(make_sc()));
  send(kStatusRequest);
  settle();
  ASSERT_EQ(telegrams.size(), 2U);
  EXPECT_EQ(telegrams[1].station, 3);
  EXPECT_TRUE(flags.empty());
}

TEST_F(MonitorTest, TwoDriversAreACollision) {
  const StationId other = segment.attach("other", nullptr);
  segment.drive(other, 0, true, true);
  send(kStatusRequest);
  ASSERT_FALSE(flags.empty());
  EXPECT_EQ(flags[0].kind, FlagKind::kCollision);
  EXPECT_THAT(flags[0].text, HasSubstr("requester drives while other does"));
}

TEST(Monitor, PassesCollisionsOnToAnEarlierListener) {
  Segment segment;
  int heard = 0;
  segment.on_collision = [&](const Collision&) { ++heard; };
  Monitor monitor(segment);
  const StationId a = segment.attach("a", nullptr), b = segment.attach("b", nullptr);
  segment.drive(a, 1, true, true);
  segment.drive(b, 2, true, true);
  EXPECT_EQ(heard, 1);
  EXPECT_EQ(monitor.statistics().flags[static_cast<std::size_t>(FlagKind::kCollision)], 1U);
}

TEST_F(MonitorTest, AGapInsideATelegramIsFlaggedFromOneBitTime) {
  ExchangeOptions options;
  options.faults.gap_before = 3;
  options.faults.gap_millibits = 900;
  send(kStatusRequest, options);
  EXPECT_TRUE(flags.empty());
  options.faults.gap_millibits = 1100;
  send(kStatusRequest, options);
  ASSERT_EQ(kinds(), Kinds{FlagKind::kGap});
  EXPECT_EQ(flags[0].text, "1.10 bit times before byte 3");
}

TEST_F(MonitorTest, SynIsViolatedBelow33BitTimes) {
  ExchangeOptions options;
  options.idle_bits = 33;
  send(kStatusRequest);
  send(kStatusRequest, options);
  EXPECT_TRUE(flags.empty());
  options.idle_bits = 32;
  send(kStatusRequest, options);
  ASSERT_EQ(kinds(), Kinds{FlagKind::kSynViolated});
  EXPECT_EQ(flags[0].text, "32.00 bit times after the last activity");
}

TEST_F(MonitorTest, WrongParityAndStopBitsAreFlagged) {
  ExchangeOptions options;
  options.faults.wrong_parity_at = 2;
  options.faults.missing_stop_at = 5;
  slave.script = nullptr;
  send(kStatusRequest, options);
  settle();
  EXPECT_EQ(kinds(), (Kinds{FlagKind::kCharacterError, FlagKind::kCharacterError}));
  EXPECT_EQ(flags[0].text, "wrong parity in byte 01");
  EXPECT_EQ(flags[1].text, "low stop bit in byte 16");
  ASSERT_EQ(telegrams.size(), 1U);
  EXPECT_TRUE(telegrams[0].character_errors);
  EXPECT_EQ(monitor.statistics().wrong, 1U);
}

TEST_F(MonitorTest, AWrongTelegramIsFlaggedOnceAndTheNextIsRead) {
  Bytes wrong = encode(make_telegram(3, 1, 0x7D, {0xE5, 0xE5, 0x10}));
  wrong[2] = 9;  // LE and LEr differ: the rest must not be taken for telegrams
  requester.send(timeline, wrong);
  send(kStatusRequest);
  ASSERT_EQ(telegrams.size(), 3U);
  EXPECT_EQ(kinds(), Kinds{FlagKind::kTelegramError});
  EXPECT_EQ(telegrams[0].decoded.error, DecodeError::kLengthMismatch);
  EXPECT_THAT(format_line(telegrams[0]), HasSubstr("wrong telegram, LE and LEr differ: 68 06 09"));
}

TEST_F(MonitorTest, ATruncatedTelegramEndsWithIdle) {
  ExchangeOptions options;
  options.faults.truncate_after = 4;
  send(kStatusRequest, options);
  settle();
  ASSERT_EQ(telegrams.size(), 1U);
  EXPECT_EQ(telegrams[0].decoded.error, DecodeError::kTruncated);
  EXPECT_EQ(telegrams[0].end - telegrams[0].start, 44 * requester.bit());
}

TEST_F(MonitorTest, AnUnansweredRequestIsFlaggedAfterTheSlotTime) {
  send(make_telegram(9, 1, 0x49));
  settle();
  ASSERT_EQ(kinds(), Kinds{FlagKind::kUnanswered});
  EXPECT_EQ(flags[0].at - telegrams[0].end, 1000 * requester.bit());
  EXPECT_EQ(monitor.statistics().stations.at(9).unanswered, 1U);
}

TEST_F(MonitorTest, AnUnansweredRequestIsFlaggedWhenTheNextBeginsEarlier) {
  ExchangeOptions options;
  options.wants_answer = false;
  send(make_telegram(9, 1, 0x49), options);
  send(kStatusRequest);
  EXPECT_EQ(kinds(), Kinds{FlagKind::kUnanswered});
}

TEST_F(MonitorTest, SdnAndTokenAreNotMissedAnAnswer) {
  send(make_telegram(kBroadcast, 1, 0x46, {0, 0}, 58, 62));
  send(make_token(1, 1));
  settle();
  EXPECT_TRUE(flags.empty());
}

TEST_F(MonitorTest, AnswersThatNobodyAskedForAreFlagged) {
  send(make_sc());
  send(kStatusAnswer);
  answer_with(encode(make_telegram(1, 4, 0x00)));
  send(kStatusRequest);
  ASSERT_EQ(kinds(), Kinds(3, FlagKind::kUnexpectedAnswer));
  EXPECT_EQ(flags[2].text, "answer of station 4 instead of 3");
}

TEST_F(MonitorTest, AGlitchIsFlaggedAndIsNoCharacter) {
  segment.force(1000, false);
  segment.force(1400, std::nullopt);
  settle();
  EXPECT_EQ(kinds(), Kinds{FlagKind::kGlitch});
  EXPECT_TRUE(telegrams.empty());
}

TEST_F(MonitorTest, FollowsAChangeOfTheBaudRate) {
  send(kStatusRequest);
  timeline.run_until(timeline.now() + kTicksPerMs);
  set_baud(9);
  send(kStatusRequest);
  ASSERT_EQ(telegrams.size(), 4U);
  EXPECT_EQ(telegrams[3].baud, 9);
  EXPECT_TRUE(flags.empty());
}

TEST_F(MonitorTest, CountsAndMeasuresEachStation) {
  for (const int tsdr : {11'000, 13'000, 15'000}) {
    answer_with(encode(kStatusAnswer), tsdr);
    send(kStatusRequest);
  }
  const MonitorStatistics& statistics = monitor.statistics();
  EXPECT_EQ(statistics.telegrams, 6U);
  EXPECT_EQ(statistics.by_kind[static_cast<std::size_t>(TelegramKind::kSd1)], 6U);
  const StationStatistics& station = statistics.stations.at(3);
  EXPECT_EQ(station.requests, 3U);
  EXPECT_EQ(station.answers, 3U);
  EXPECT_EQ(station.tsdr_min, 11'000);
  EXPECT_EQ(station.tsdr_max, 15'000);
  EXPECT_EQ(station.tsdr_mean(), 13'000);
  EXPECT_EQ(StationStatistics{}.tsdr_mean(), 0);
}

TEST_F(MonitorTest, LogLinesHoldTimeRateTsdrAndWords) {
  ExchangeOptions options;
  options.at = 12'005;
  send(kStatusRequest, options);
  EXPECT_EQ(format_line(telegrams[0]), "        1000.416 ns     12M  1 -> 3  request FDL status FCB=0 FCV=0");
  EXPECT_THAT(format_line(telegrams[1]), HasSubstr("TSDR 11.00 (916.666 ns)  3 -> 1  response OK"));
  EXPECT_EQ(format_line(Flag{FlagKind::kGap, 24, "why"}), "           2.000 ns  FLAG gap: why");
}

TEST(Monitor, EveryFlagHasItsName) {
  for (std::size_t i = 0; i < kFlagKinds; ++i) EXPECT_STRNE(name(static_cast<FlagKind>(i)), "");
}

}  // namespace
}  // namespace dsdpv1::bus
