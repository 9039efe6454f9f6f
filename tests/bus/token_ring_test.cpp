#include "bus/master/token_ring.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "bus/master/master1.hpp"
#include "bus/master/master2.hpp"
#include "bus/master/requester.hpp"
#include "bus/monitor/monitor.hpp"
#include "bus/token/token_watch.hpp"
#include "tests/bus/fake_slave.hpp"

namespace dsdpv1::bus {
namespace {

using test::FakeDpSlave;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::uint8_t kHighest = 12;

SlaveParameters slave_at(std::uint8_t address) {
  SlaveParameters slave;
  slave.address = address;
  slave.ident = 0x0B9A;
  slave.cfg = {0x11, 0x21};
  slave.input_length = slave.output_length = 2;
  return slave;
}

/// Class-2 masters without connections are plain masters: the ring alone.
struct Ring {
  explicit Ring(int baud_index = 0) : slave(segment, timeline, 11), monitor(segment), baud_(baud_index) {
    slave.station.set_baud(baud_index);
    monitor.set_baud(baud_index);
    timeline.add(monitor);
    monitor.on_flag = [this](const Flag& flag) {
      if (flag.kind != FlagKind::kUnanswered) flags.push_back(format_line(flag));
    };
    monitor.on_telegram = [this](const WireTelegram& wire) { telegrams.push_back(wire); };
  }
  static BusParameters bus_parameters() {
    BusParameters bus;
    bus.ring = true;
    bus.highest_address = kHighest;
    bus.gap_factor = 1;
    bus.target_rotation_bits = 20'000;
    return bus;
  }
  MasterConfig config(std::uint8_t address) const {
    MasterConfig config;
    config.name = "master " + std::to_string(address);
    config.address = address;
    config.baud = baud_;
    config.bus = bus_parameters();
    return config;
  }
  Master2& add(std::uint8_t address) {
    masters.push_back(std::make_unique<Master2>(segment, config(address)));
    timeline.add(*masters.back());
    return *masters.back();
  }
  void run_bits(Tick bits) { timeline.run_until(timeline.now() + bits * bit()); }
  Tick bit() const { return baud(baud_).bit; }
  bool run_until(const std::function<bool()>& condition, Tick limit_bits = 2'000'000) {
    const Tick end = timeline.now() + limit_bits * bit();
    while (!condition() && timeline.step(end)) {
    }
    return condition();
  }
  /// SA of the tokens on the wire since the last call, repetitions included.
  std::vector<std::pair<int, int>> tokens() {
    std::vector<std::pair<int, int>> list;
    for (const WireTelegram& wire : telegrams) {
      const Telegram& telegram = wire.decoded.telegram;
      if (wire.right() && telegram.kind == TelegramKind::kSd4) list.emplace_back(telegram.sa, telegram.da);
    }
    telegrams.clear();
    return list;
  }
  bool all_in(const std::vector<std::uint8_t>& addresses) const {
    for (const auto& master : masters)
      if (master->running() && (!master->ring().in_ring() || master->ring().stations().addresses() != addresses))
        return false;
    return true;
  }
  /// A master without messages only has the token for its GAP poll and to pass it on.
  bool has_token(std::size_t master) const {
    const RingState state = masters[master]->ring().state();
    return state == RingState::kGapPoll || state == RingState::kPassToken;
  }
  void start_all() {
    for (const auto& master : masters) master->start();
    settle();
  }
  /// Runs pending starts and stops.
  void settle() { timeline.run_until(timeline.now()); }
  void stop(std::size_t master) {
    masters[master]->stop();
    settle();
  }

  Segment segment;
  Timeline timeline;
  FakeDpSlave slave;
  Monitor monitor;
  int baud_;
  std::vector<std::unique_ptr<Master2>> masters;
  std::vector<std::string> flags;
  std::vector<WireTelegram> telegrams;
};

struct TokenRingTest : testing::Test, Ring {};

class TokenRingAtEveryBaud : public testing::TestWithParam<int>, public Ring {
 public:
  TokenRingAtEveryBaud() : Ring(GetParam()) {}
};
INSTANTIATE_TEST_SUITE_P(Bauds, TokenRingAtEveryBaud, testing::Range(0, kBaudCount));

TEST(ActiveStations, NextAndPreviousGoRound) {
  ActiveStations stations;
  stations.add(2);
  EXPECT_EQ(stations.next_after(2), 2);
  stations.add(7);
  stations.add(126);
  EXPECT_EQ(stations.next_after(2), 7);
  EXPECT_EQ(stations.next_after(126), 2);
  EXPECT_EQ(stations.previous_of(2), 126);
  EXPECT_EQ(stations.previous_of(7), 2);
  EXPECT_EQ(stations.next_after(50), 126);
}

TEST(ActiveStations, ATokenRemovesThoseItSkips) {
  ActiveStations stations;
  for (const int address : {1, 3, 5, 9}) stations.add(static_cast<std::uint8_t>(address));
  stations.token_passed(1, 5);
  EXPECT_THAT(stations.addresses(), ElementsAre(1, 5, 9));
  stations.token_passed(5, 1);
  EXPECT_THAT(stations.addresses(), ElementsAre(1, 5));
  stations.token_passed(8, 8);
  EXPECT_THAT(stations.addresses(), ElementsAre(8));
}

TEST(ActiveStations, SkippingGoesRoundToo) {
  EXPECT_TRUE(token_skips(1, 5, 3));
  EXPECT_FALSE(token_skips(1, 5, 5));
  EXPECT_FALSE(token_skips(1, 5, 1));
  EXPECT_FALSE(token_skips(1, 5, 9));
  EXPECT_TRUE(token_skips(5, 1, 9));
  EXPECT_TRUE(token_skips(5, 1, 0));
  EXPECT_FALSE(token_skips(5, 1, 3));
  EXPECT_TRUE(token_skips(4, 4, 3));
}

TEST(StationLearner, NeedsTwoEqualRotations) {
  StationLearner learner;
  learner.token_passed(2, 3);  // the rest of a rotation
  learner.token_passed(3, 1);
  for (int rotation = 0; rotation < 2; ++rotation) {
    EXPECT_FALSE(learner.valid());
    learner.token_passed(1, 2);
    learner.token_passed(2, 3);
    learner.token_passed(3, 1);
  }
  EXPECT_TRUE(learner.valid());
  EXPECT_THAT(learner.stations().addresses(), ElementsAre(1, 2, 3));
  learner.token_passed(1, 3);
  learner.token_passed(3, 1);
  EXPECT_FALSE(learner.valid());
}

TEST_P(TokenRingAtEveryBaud, ThreeMastersFormARingWithoutAFlag) {
  for (const int address : {2, 5, 9}) add(static_cast<std::uint8_t>(address));
  start_all();
  ASSERT_TRUE(run_until([this] { return all_in({2, 5, 9}); }));
  tokens();
  run_bits(5000);
  const auto passed = tokens();
  ASSERT_GE(passed.size(), 6U);
  for (const auto& [from, to] : passed) EXPECT_EQ(to, from == 2 ? 5 : from == 5 ? 9 : 2);
  EXPECT_TRUE(flags.empty()) << flags.front();
}

TEST_F(TokenRingTest, AMasterAloneClaimsAfterItsTimeoutAndPassesTheTokenToItself) {
  Master2& master = add(4);
  const Tick started = timeline.now();
  master.start();
  run_bits(40'000);
  ASSERT_FALSE(telegrams.empty());
  EXPECT_EQ(telegrams.front().start - started, (6 + 2 * 4) * 1000 * bit());
  for (const auto& [from, to] : tokens()) EXPECT_TRUE(from == 4 && to == 4);
  EXPECT_EQ(master.ring().statistics().claims, 1U);
  EXPECT_GT(master.ring().statistics().rotations.count, 20U);
}

TEST_F(TokenRingTest, TheGapIsLookedThroughOneAddressATokenAndAgainAfterItsTime) {
  Master2& master = add(4);
  master.start();
  run_bits(60'000);
  std::vector<int> polled;
  int tokens_between = 0;
  for (const WireTelegram& wire : telegrams) {
    const Telegram& telegram = wire.decoded.telegram;
    if (telegram.kind == TelegramKind::kSd4) ++tokens_between;
    if (!telegram.is_request()) continue;
    EXPECT_EQ(telegram.function(), fc::kFdlStatus);
    EXPECT_GT(tokens_between, 0);
    tokens_between = 0;
    polled.push_back(telegram.da);
  }
  ASSERT_GE(polled.size(), 24U);
  const std::vector<int> round = {5, 6, 7, 8, 9, 10, 11, 12, 0, 1, 2, 3};
  EXPECT_EQ(std::vector<int>(polled.begin(), polled.begin() + 12), round);
  EXPECT_EQ(std::vector<int>(polled.begin() + 12, polled.begin() + 24), round);
}

TEST_F(TokenRingTest, AMasterEntersARunningRingWhenItIsPolled) {
  add(2);
  add(5);
  start_all();
  ASSERT_TRUE(run_until([this] { return all_in({2, 5}); }));
  Master2& third = add(8);
  std::vector<RingState> states;
  third.ring().on_state = [&](Tick, RingState, RingState to, const char*) { states.push_back(to); };
  third.start();
  settle();
  ASSERT_TRUE(run_until([this] { return all_in({2, 5, 8}); }));
  EXPECT_THAT(states, testing::Contains(RingState::kActiveIdle));
  EXPECT_EQ(third.ring().statistics().claims, 0U);
  EXPECT_THAT(flags, IsEmpty());
}

TEST_F(TokenRingTest, WhileItDoesNotKnowTheRingAMasterIsNotReady) {
  Requester requester(segment);
  timeline.add(requester);
  add(5).start();
  timeline.run_until(1000 * bit());
  const Exchange exchange = requester.send(timeline, make_telegram(5, 1, fc::kRequest | fc::kFdlStatus));
  ASSERT_TRUE(exchange.answered());
  EXPECT_EQ(exchange.answer().fc, 0x10);
  EXPECT_DOUBLE_EQ(exchange.tsdr_bits(), 11.0);
}

TEST_F(TokenRingTest, InTheRingItAnswersFdlStatusWithInRingAndRefusesEverythingElse) {
  Requester requester(segment);
  timeline.add(requester);
  Master2& five = add(5);
  const auto pass = [&](int sa, int da) {
    ExchangeOptions options;
    options.wants_answer = false;
    requester.send(timeline, make_token(static_cast<std::uint8_t>(da), static_cast<std::uint8_t>(sa)), options);
  };
  five.start();
  timeline.step(kNever - 1);
  for (int i = 0; i < 3; ++i) pass(1, 1);
  EXPECT_EQ(requester.send(timeline, make_telegram(5, 1, 0x49)).answer().fc, 0x20);
  EXPECT_EQ(five.ring().state(), RingState::kActiveIdle);
  EXPECT_EQ(requester.send(timeline, make_telegram(5, 1, 0x49)).answer().fc, 0x30);
  EXPECT_EQ(requester.send(timeline, make_telegram(5, 1, 0x6D, {1}, 60, 62)).answer().fc, 0x33);
}

TEST_F(TokenRingTest, ADeadMasterWithoutTheTokenIsPassedOverAfterThreeTokens) {
  for (const int address : {2, 5, 9}) add(static_cast<std::uint8_t>(address));
  start_all();
  ASSERT_TRUE(run_until([this] { return all_in({2, 5, 9}); }));
  ASSERT_TRUE(run_until([this] { return has_token(0); }));
  stop(1);
  tokens();
  const std::uint64_t retries = masters[0]->ring().statistics().token_retries;
  ASSERT_TRUE(run_until([this] { return all_in({2, 9}); }));
  int to_the_dead = 0;
  for (const auto& [from, to] : tokens()) to_the_dead += to == 5 ? 1 : 0;
  EXPECT_EQ(to_the_dead, kTokenAttempts);
  EXPECT_EQ(masters[0]->ring().statistics().stations_dropped, 1U);
  // Two to the dead one; one to master 9, which accepts a token from another station than its previous one only if it
  // is repeated.
  EXPECT_EQ(masters[0]->ring().statistics().token_retries - retries, 3U);
  EXPECT_THAT(flags, IsEmpty());
}

TEST_F(TokenRingTest, AMasterThatDiesWithTheTokenIsReplacedByTheLowestAddressAfterItsTimeout) {
  for (const int address : {2, 5, 9}) add(static_cast<std::uint8_t>(address));
  start_all();
  ASSERT_TRUE(run_until([this] { return all_in({2, 5, 9}); }));
  const auto polls = [this] { return !telegrams.empty() && telegrams.back().decoded.telegram.is_request(); };
  ASSERT_TRUE(run_until([&] { return polls() && telegrams.back().decoded.telegram.sa == 9; }));
  const Tick died = timeline.now();
  stop(2);
  ASSERT_TRUE(run_until([this] { return masters[0]->ring().statistics().claims == 2; }));  // one began the ring
  EXPECT_NEAR(static_cast<double>(timeline.now() - died), static_cast<double>((6 + 2 * 2) * 1000 * bit()), 10.0 * 1000);
  EXPECT_TRUE(has_token(0));
  ASSERT_TRUE(run_until([this] { return all_in({2, 5}); }));
  EXPECT_EQ(masters[1]->ring().statistics().claims, 0U);
  EXPECT_THAT(flags, IsEmpty());
}

TEST_F(TokenRingTest, ALostTokenIsRecoveredAndTheRingIsTheSame) {
  for (const int address : {2, 5}) add(static_cast<std::uint8_t>(address));
  start_all();
  ASSERT_TRUE(run_until([this] { return all_in({2, 5}); }));
  // A short circuit blocks everything for longer than any repetition of the token.
  segment.force(timeline.now(), false);
  run_bits(20);
  segment.force(timeline.now(), std::nullopt);
  EXPECT_TRUE(run_until([this] { return all_in({2, 5}); }));
  tokens();
  run_bits(20'000);
  EXPECT_TRUE(all_in({2, 5}));
  EXPECT_GT(tokens().size(), 15U);  // with a GAP poll each
}

TEST_F(TokenRingTest, AMasterComesBackIntoTheRing) {
  for (const int address : {2, 5}) add(static_cast<std::uint8_t>(address));
  start_all();
  ASSERT_TRUE(run_until([this] { return all_in({2, 5}); }));
  stop(1);
  ASSERT_TRUE(run_until([this] { return all_in({2}); }));
  masters[1]->start();
  settle();
  EXPECT_TRUE(run_until([this] { return masters[1]->ring().in_ring() && all_in({2, 5}); }));
}

TEST_F(TokenRingTest, AMasterWithAnAddressThatIsInUseLeavesTheRingToTheOther) {
  for (const int address : {2, 5}) add(static_cast<std::uint8_t>(address));
  start_all();
  ASSERT_TRUE(run_until([this] { return all_in({2, 5}); }));
  masters.push_back(std::make_unique<Master2>(segment, config(5)));
  timeline.add(*masters.back());
  masters.back()->start();
  settle();
  EXPECT_TRUE(run_until([this] { return masters.back()->ring().state() == RingState::kOut; }));
  EXPECT_TRUE(masters[1]->ring().in_ring());
  EXPECT_THAT(flags, IsEmpty());
}

TEST_F(TokenRingTest, ASecondTokenIsGivenUp) {
  for (const int address : {2, 5}) add(static_cast<std::uint8_t>(address));
  start_all();
  ASSERT_TRUE(run_until([this] { return all_in({2, 5}); }));
  Requester intruder(segment, "intruder");
  timeline.add(intruder);
  ASSERT_TRUE(run_until([this] { return has_token(0); }));
  ExchangeOptions options;
  options.at = timeline.now() + bit();  // while master 2 waits for its idle time
  options.wants_answer = false;
  intruder.send(timeline, make_token(9, 7), options);
  EXPECT_EQ(masters[0]->ring().statistics().tokens_given_up, 1U);
  EXPECT_FALSE(masters[0]->ring().holds_token());
  EXPECT_TRUE(run_until([this] { return all_in({2, 5}); }));
}

TEST_F(TokenRingTest, ATokenFromAStrangerIsTakenOnlyWhenItIsRepeated) {
  Requester other(segment);
  timeline.add(other);
  Master2& five = add(5);
  five.start();
  timeline.step(kNever - 1);
  ExchangeOptions options;
  options.wants_answer = false;
  const auto pass = [&](int sa, int da) {
    other.send(timeline, make_token(static_cast<std::uint8_t>(da), static_cast<std::uint8_t>(sa)), options);
    timeline.run_until(timeline.now() + 10 * bit());
  };
  for (int i = 0; i < 3; ++i) pass(1, 1);
  other.send(timeline, make_telegram(5, 1, 0x49));
  pass(4, 5);
  EXPECT_FALSE(five.ring().holds_token());
  pass(4, 5);
  EXPECT_EQ(five.ring().state(), RingState::kGapPoll);
  EXPECT_EQ(five.ring().stations().addresses(), (std::vector<std::uint8_t>{1, 4, 5}));
}

TEST_F(TokenRingTest, TokensKeepTheirIdleTimes) {
  for (const int address : {2, 5}) add(static_cast<std::uint8_t>(address));
  start_all();
  ASSERT_TRUE(run_until([this] { return all_in({2, 5}); }));
  telegrams.clear();
  run_bits(3000);
  for (std::size_t i = 1; i < telegrams.size(); ++i) {
    const Tick idle = telegrams[i].start - telegrams[i - 1].end;
    if (telegrams[i - 1].decoded.telegram.kind == TelegramKind::kSd4) EXPECT_EQ(idle, bus_parameters().id1(0) * bit());
  }
}

TEST_F(TokenRingTest, TheMonitorMeasuresTheRotationsThatTheMastersHave) {
  for (const int address : {2, 5}) add(static_cast<std::uint8_t>(address));
  start_all();
  ASSERT_TRUE(run_until([this] { return all_in({2, 5}); }));
  run_bits(50'000);
  ASSERT_TRUE(run_until([this] { return has_token(0); }));
  const RotationStatistics& seen = monitor.rotations().at(5);
  const RotationStatistics& own = masters[1]->ring().statistics().rotations;
  EXPECT_EQ(seen.count, own.count);
  EXPECT_EQ(seen.min, own.min);
  EXPECT_EQ(seen.max, own.max);
  EXPECT_EQ(seen.mean(), own.mean());
  // At least two tokens and their idle times.
  EXPECT_GE(seen.min, 2 * (33 + bus_parameters().id1(0)) * bit());
}

TEST_F(TokenRingTest, TheMonitorFlagsAMasterThatTalksWithoutTheToken) {
  for (const int address : {2, 5}) add(static_cast<std::uint8_t>(address));
  start_all();
  ASSERT_TRUE(run_until([this] { return all_in({2, 5}); }));
  run_bits(5000);
  flags.clear();
  Requester intruder(segment, "intruder");
  timeline.add(intruder);
  ASSERT_TRUE(run_until([this] { return has_token(0); }));
  ExchangeOptions options;
  options.at = timeline.now() + 34 * bit();  // T_SYN later, while master 2 still waits for T_ID1
  options.wants_answer = false;
  intruder.send(timeline, make_telegram(11, 9, fc::kRequest | fc::kSdnHigh, {0}, 58, 62), options);
  run_bits(100);
  ASSERT_EQ(flags.size(), 1U);
  EXPECT_THAT(flags[0], testing::HasSubstr("FLAG two masters: master 9 sends while 2 has the token"));
}

TEST(TokenWatch, ClaimsAfterTheTimeoutAndRepeatedTokensAreRight) {
  TokenWatch watch;
  constexpr Tick kSlot = 100;
  const Telegram to_2 = make_token(2, 1), to_1 = make_token(1, 2);
  EXPECT_FALSE(watch.hear(to_2, 1000, 50, kSlot));
  EXPECT_FALSE(watch.hear(to_2, 1200, 100, kSlot));
  EXPECT_FALSE(watch.hear(to_1, 2000, 50, kSlot));
  EXPECT_FALSE(watch.hear(to_2, 2500, 50, kSlot));
  EXPECT_EQ(watch.rotations().at(2).count, 1U);
  EXPECT_EQ(watch.rotations().at(2).min, 2500 - 1200);
  EXPECT_FALSE(watch.hear(make_telegram(3, 2, 0x49), 2600, 50, kSlot));
  EXPECT_TRUE(watch.hear(make_telegram(3, 1, 0x49), 2700, 599, kSlot));
  EXPECT_FALSE(watch.hear(make_telegram(3, 2, 0x49), 3400, 600, kSlot));
  EXPECT_EQ(watch.holder(), 2);
}

TEST(TokenWatch, AMasterThatPassesTheTokenToItselfHoldsIt) {
  TokenWatch watch;
  EXPECT_FALSE(watch.hear(make_telegram(3, 9, 0x49), 500, 50, 100)) << "there is no token";
  EXPECT_FALSE(watch.hear(make_token(1, 1), 1000, 50, 100));
  EXPECT_TRUE(watch.hear(make_telegram(3, 9, 0x49), 2000, 50, 100));
  EXPECT_FALSE(watch.hear(make_telegram(3, 1, 0x49), 2500, 50, 100)) << "it still has it";
  EXPECT_TRUE(watch.hear(make_token(9, 9), 3000, 50, 100));
  EXPECT_FALSE(watch.hear(make_telegram(3, 7, 0x49), 4000, 600, 100)) << "claimed after T_TO";
  EXPECT_TRUE(watch.hear(make_telegram(3, 9, 0x49), 5000, 50, 100)) << "and has it now";
}

TEST_F(TokenRingTest, ATokenThatIsNotOnTheLineAsSentIsGivenUp) {
  Master2& master = add(2);
  start_all();
  run_bits(20'000);
  ASSERT_TRUE(run_until([&] { return master.ring().state() == RingState::kPassToken && !segment.level(); }));
  segment.force(timeline.now(), false);
  run_bits(40);
  segment.force(timeline.now(), std::nullopt);
  EXPECT_EQ(master.ring().statistics().tokens_given_up, 1U);
  EXPECT_EQ(master.ring().state(), RingState::kListenToken);
  run_bits(20'000);
  EXPECT_TRUE(master.ring().in_ring());
  EXPECT_EQ(master.ring().statistics().claims, 2U);
}

/// Masters die and come back at any time, each draw another seed; the ring must form again without a collision.
TEST_F(TokenRingTest, WhateverStopsAndStartsTheRingComesTogetherAgain) {
  const std::vector<std::uint8_t> all = {1, 4, 5, 10};
  for (const std::uint8_t address : all) add(address);
  std::vector<bool> on(all.size(), true);
  start_all();
  std::uint32_t random = 12345;
  const auto draw = [&random](std::uint32_t below) {
    random = random * 1664525U + 1013904223U;
    return (random >> 8) % below;
  };
  for (int round = 0; round < 60; ++round) {
    run_bits(draw(3000));
    const std::size_t which = draw(static_cast<std::uint32_t>(all.size()));
    on[which] = !on[which];
    if (on[which])
      masters[which]->start();
    else
      masters[which]->stop();
    settle();
    if (round % 3 != 0) continue;  // two more before the ring has settled
    std::vector<std::uint8_t> expected;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (on[i]) expected.push_back(all[i]);
    ASSERT_TRUE(run_until([&] { return all_in(expected); })) << "round " << round;
  }
}

// --- two class-1 masters ---------------------------------------------------------------------------------------------

struct TwoMasters : testing::Test, Ring {
  TwoMasters() : other(segment, timeline, 10) {
    for (const int address : {1, 4}) {
      cyclic.push_back(std::make_unique<Master1>(segment, config(static_cast<std::uint8_t>(address))));
      timeline.add(*cyclic.back());
    }
    cyclic[0]->add_slave(slave_at(11));
    cyclic[1]->add_slave(slave_at(10));
  }
  bool exchanging() const {
    return cyclic[0]->slave(11).state == SlaveState::kDataExchange &&
           cyclic[1]->slave(10).state == SlaveState::kDataExchange;
  }
  FakeDpSlave other;
  std::vector<std::unique_ptr<Master1>> cyclic;
};

TEST_F(TwoMasters, BothExchangeDataWithTheirSlaves) {
  for (const auto& master : cyclic) master->start();
  ASSERT_TRUE(run_until([this] { return exchanging(); }));
  run_bits(100'000);
  EXPECT_TRUE(exchanging());
  EXPECT_EQ(cyclic[0]->slave(11).counters.timeouts, 0U);
  EXPECT_GT(cyclic[0]->cycles(), 50U);
  EXPECT_GT(cyclic[1]->cycles(), 50U);
  EXPECT_THAT(flags, IsEmpty());
}

TEST_F(TwoMasters, WithoutTimeLeftNoLowPriorityMessageIsSent) {
  BusParameters none = bus_parameters();
  none.target_rotation_bits = 0;
  MasterConfig hurried = config(7);
  hurried.bus = none;
  Master1 third(segment, hurried);
  timeline.add(third);
  for (const auto& master : cyclic) master->start();
  third.start();
  for (int i = 0; i < 10; ++i) third.fdl_status(11);
  ASSERT_TRUE(run_until([&] { return third.ring()->in_ring(); }));
  run_bits(20'000);
  telegrams.clear();
  run_bits(50'000);
  int tokens_to = 0, low = 0;
  for (const WireTelegram& wire : telegrams) {
    const Telegram& telegram = wire.decoded.telegram;
    tokens_to += telegram.kind == TelegramKind::kSd4 && telegram.da == 7 ? 1 : 0;
    low += telegram.is_request() && telegram.sa == 7 ? 1 : 0;
  }
  EXPECT_GT(tokens_to, 10);
  EXPECT_EQ(low, 0);
  EXPECT_THAT(flags, IsEmpty());
}

TEST_F(TwoMasters, WithoutTimeLeftOneHighPriorityMessageATokenIsSent) {
  BusParameters none = bus_parameters();
  none.target_rotation_bits = 0;
  MasterConfig hurried = config(7);
  hurried.bus = none;
  Master1 third(segment, hurried);
  timeline.add(third);
  cyclic[0]->start();
  third.start();
  ASSERT_TRUE(run_until([&] { return third.ring()->in_ring(); }));
  int sent = 0;
  for (int i = 0; i < 5; ++i) third.global_control(0, 0, kBroadcast, [&](const FdlResult&) { ++sent; });
  telegrams.clear();
  ASSERT_TRUE(run_until([&] { return sent == 5; }));
  int since_token = 0;
  for (const WireTelegram& wire : telegrams) {
    const Telegram& telegram = wire.decoded.telegram;
    if (telegram.kind == TelegramKind::kSd4) since_token = 0;
    if (telegram.is_request() && telegram.sa == 7) EXPECT_EQ(++since_token, 1);
  }
}

TEST_F(TwoMasters, TheOtherGoesOnWhenOneDies) {
  for (const auto& master : cyclic) master->start();
  ASSERT_TRUE(run_until([this] { return exchanging(); }));
  cyclic[0]->stop();
  run_bits(40'000);
  const std::uint64_t before = cyclic[1]->slave(10).counters.data_exchanges;
  run_bits(40'000);
  EXPECT_GT(cyclic[1]->slave(10).counters.data_exchanges, before + 20);
  EXPECT_EQ(cyclic[1]->slave(10).counters.parameterisations, 1U);
  cyclic[0]->start();
  EXPECT_TRUE(run_until([this] { return cyclic[0]->ring()->in_ring() && exchanging(); }));
}

}  // namespace
}  // namespace dsdpv1::bus
