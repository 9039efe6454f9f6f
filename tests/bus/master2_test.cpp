#include "bus/master/master2.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include "bus/monitor/monitor.hpp"
#include "tests/bus/fake_acyclic.hpp"
#include "tests/bus/fake_slave.hpp"

namespace dsdpv1::bus {
namespace {

using test::FakeC2;
using test::FakeDpSlave;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::uint16_t kSendTimeout = 5;  // 50 ms
constexpr Tick kT = kSendTimeout * kTimeUnit10ms;

/// A slave with two channels, a class-2 master and a monitor that must flag nothing.
struct Class2 : testing::Test {
  Class2()
      : slave(segment, timeline, 3),
        c2([this] { return slave.station.ends.back(); }),
        master(segment, config(5)),
        monitor(segment) {
    slave.acyclic = [this](const Telegram& request) { return c2.hear(request); };
    slave.unanswered = [this](const Telegram& request) { c2.hear_unanswered(request); };
    timeline.add(master);
    timeline.add(monitor);
    monitor.on_flag = [this](const Flag& flag) { flags.push_back(format_line(flag)); };
    monitor.on_telegram = [this](const WireTelegram& wire) { telegrams.push_back(wire); };
    watch(master);
    master.start();
  }
  static MasterConfig config(std::uint8_t address) {
    MasterConfig config;
    config.address = address;
    config.bus.gap_factor = 0;
    return config;
  }
  void watch(Master2& each) {
    each.on_end = [this](Tick, ConnectionId, const ConnectionEnd& end) { ends.push_back(end); };
    each.on_state = [this](Tick, ConnectionId, ConnectionState, ConnectionState to) { states.push_back(to); };
  }
  static ConnectionParameters parameters() {
    ConnectionParameters parameters;
    parameters.slave = 3;
    parameters.send_timeout = kSendTimeout;
    return parameters;
  }
  ConnectionId open(const ConnectionParameters& how = parameters()) {
    const ConnectionId id = master.add_connection(how);
    master.connect(id);
    return id;
  }
  ConnectionId connected(const ConnectionParameters& how = parameters()) {
    const ConnectionId id = open(how);
    EXPECT_TRUE(run_until([&] { return master.connection(id).state() == ConnectionState::kOpen; }));
    return id;
  }
  bool run_until(const std::function<bool()>& condition, Tick limit = 20 * kT) {
    const Tick end = timeline.now() + limit;
    while (!condition() && timeline.step(end)) {
    }
    return condition();
  }
  void run(Tick ticks) { timeline.run_until(timeline.now() + ticks); }
  bool ended(std::size_t count = 1) {
    return run_until([&] { return ends.size() >= count; });
  }
  AcyclicCallback keep() {
    return [this](const AcyclicResult& result) { results.push_back(result); };
  }
  AcyclicResult last() {
    const std::size_t before = results.size();
    EXPECT_TRUE(run_until([&] { return results.size() > before; }));
    return results.empty() ? AcyclicResult{} : results.back();
  }
  AcyclicResult read(ConnectionId id, std::uint8_t length = 4) {
    master.read(id, 1, 2, length, keep());
    return last();
  }
  ConnectionState state(ConnectionId id) const { return master.connection(id).state(); }

  Segment segment;
  Timeline timeline;
  FakeDpSlave slave;
  FakeC2 c2;
  Master2 master;
  Monitor monitor;
  std::vector<std::string> flags;
  std::vector<WireTelegram> telegrams;
  std::vector<ConnectionEnd> ends;
  std::vector<ConnectionState> states;
  std::vector<AcyclicResult> results;
};

TEST_F(Class2, ConnectsWithInitiateAndTwoAnswers) {
  const ConnectionId id = connected();
  EXPECT_THAT(states, ElementsAre(ConnectionState::kInitiating, ConnectionState::kConnecting, ConnectionState::kOpen));
  EXPECT_EQ(c2.channels[0].initiate, (Bytes{0x57, 0, 0, 0, 0, 5, 1, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(master.connection(id).granted().sap, 0x30);
  EXPECT_EQ(master.connection(id).granted().max_length, 0xF0);
  EXPECT_EQ(master.connection(id).granted().send_timeout, kSendTimeout);
  EXPECT_TRUE(flags.empty()) << flags.front();
}

TEST_F(Class2, TheLongFormOfAddAddr) {
  ConnectionParameters how = parameters();
  how.add_addr = long_add_addr({1, {0xA0, 0xA1}}, {0, {0xB0}});
  EXPECT_EQ(how.add_addr, (Bytes{1, 2, 0, 1, 0xA0, 0xA1, 0xB0}));
  connected(how);
  EXPECT_EQ(Bytes(c2.channels[0].initiate.begin() + 12, c2.channels[0].initiate.end()), how.add_addr);
  EXPECT_EQ(short_add_addr(3, 4), (Bytes{3, 4}));
  EXPECT_THROW(long_add_addr({0, Bytes(200, 0)}, {0, Bytes(100, 0)}), std::invalid_argument);
}

TEST_F(Class2, AnInitiateThatIsOnlyAcknowledgedIsPolledForItsAnswer) {
  c2.immediate_polls = 3;
  connected();
}

TEST_F(Class2, ReadsWritesAndTransportsEveryLength) {
  const ConnectionId id = connected();
  for (auto& channel : c2.channels) channel.mailbox.busy_polls = 0;
  for (std::size_t length = 0; length <= kMaxAcyclicData; ++length) {
    EXPECT_EQ(read(id, static_cast<std::uint8_t>(length)).data.size(), length);
    master.write(id, 0, 0, Bytes(length, 1), keep());
    EXPECT_TRUE(last().positive());
    master.transport(id, 0, 0, Bytes(length, 0x0F), keep());
    EXPECT_EQ(last().data, Bytes(length, 0xF0));
  }
  EXPECT_THROW(master.write(id, 0, 0, Bytes(kMaxAcyclicData + 1, 0)), std::invalid_argument);
  EXPECT_THROW(master.transport(id, 0, 0, Bytes(kMaxAcyclicData + 1, 0)), std::invalid_argument);
  EXPECT_TRUE(flags.empty()) << flags.front();
}

TEST_F(Class2, ANegativeAnswerLeavesTheConnectionOpen) {
  const ConnectionId id = connected();
  c2.channels[0].mailbox.user = [](const Bytes& request) {
    return Bytes{static_cast<std::uint8_t>(request[0] | 0x80U), 0x80, 0xB0, 0};
  };
  EXPECT_EQ(describe(read(id)), "DS_Read slot 1 index 2: refused, access: invalid index");
  EXPECT_EQ(state(id), ConnectionState::kOpen);
}

TEST_F(Class2, IdleKeepsAnOpenConnectionAlive) {
  const ConnectionId id = connected();
  run(10 * kT);
  EXPECT_EQ(state(id), ConnectionState::kOpen);
  EXPECT_GE(c2.idles, 9);
  EXPECT_LE(c2.idles, 11);
  EXPECT_TRUE(read(id).positive());
}

TEST_F(Class2, RequestsMakeIdleUnnecessary) {
  const ConnectionId id = connected();
  for (int i = 0; i < 20; ++i) {
    run(kT / 4);
    read(id);
  }
  EXPECT_EQ(c2.idles, 0);
}

TEST_F(Class2, TwoChannelsToOneSlaveAtOnceAndAThirdIsRefused) {
  const ConnectionId first = connected(), second = connected();
  EXPECT_EQ(master.connection(second).granted().sap, 0x2F);
  c2.channels[0].mailbox.busy_polls = 20;
  master.read(first, 0, 0, 1, keep());
  master.read(second, 0, 0, 2, keep());
  EXPECT_EQ(last().data.size(), 2U);
  EXPECT_EQ(last().data.size(), 1U);
  const ConnectionId third = open();
  ASSERT_TRUE(ended());
  EXPECT_EQ(ends[0].by, ConnectionEnd::By::kRefused);
  EXPECT_THAT(ends[0].words, HasSubstr("no free channel"));
  EXPECT_EQ(state(third), ConnectionState::kClosed);
}

TEST_F(Class2, TwoSlavesAtOnce) {
  FakeDpSlave other(segment, timeline, 7);
  FakeC2 other_c2([&other] { return other.station.ends.back(); });
  other.acyclic = [&](const Telegram& request) { return other_c2.hear(request); };
  ConnectionParameters how = parameters();
  how.slave = 7;
  const ConnectionId first = connected(), second = connected(how);
  EXPECT_TRUE(read(first).positive());
  EXPECT_TRUE(read(second).positive());
  EXPECT_EQ(other_c2.channels[0].mailbox.requests.size(), 1U);
}

TEST_F(Class2, AnAbortTellsTheSlaveAndFreesItsChannel) {
  const ConnectionId id = connected();
  AbortReason reason;
  reason.detail = 9;
  master.abort(id, reason);
  ASSERT_TRUE(ended());
  EXPECT_EQ(c2.aborts, (std::vector<Bytes>{{0x58, 1, 0x20, 9}}));
  EXPECT_EQ(ends[0].by, ConnectionEnd::By::kMaster);
  EXPECT_EQ(ends[0].words, "aborted by the master: user: reason 0, local subnet, detail 9");
  connected();
  EXPECT_EQ(c2.channels[1].state, FakeC2::Channel::State::kFree);
}

TEST_F(Class2, AnAbortAsSdnIsNotAnswered) {
  const ConnectionId id = connected();
  AbortReason reason;
  reason.sdn = true;
  master.abort(id, reason);
  ASSERT_TRUE(ended());
  EXPECT_EQ(c2.aborts.size(), 1U);
}

TEST_F(Class2, AnAbortBeforeTheChannelIsKnownEndsWithoutAWord) {
  const ConnectionId id = open();
  master.abort(id);
  EXPECT_EQ(ends.size(), 1U);
  EXPECT_EQ(state(id), ConnectionState::kClosed);
}

TEST_F(Class2, AnAbortLosesWhatWaits) {
  const ConnectionId id = connected();
  c2.channels[0].mailbox.busy_polls = -1;
  master.read(id, 0, 0, 1, keep());
  master.read(id, 0, 1, 1, keep());
  run(kTicksPerMs);
  master.abort(id);
  ASSERT_TRUE(ended());
  ASSERT_EQ(results.size(), 2U);
  for (const AcyclicResult& result : results) EXPECT_EQ(result.outcome, AcyclicOutcome::kLost);
  EXPECT_THROW(master.read(id, 0, 0, 1), std::logic_error);
}

TEST_F(Class2, TheSlavesAbortIsReportedInWords) {
  const ConnectionId id = connected();
  c2.abort_next = {0x58, 0, 0x13, 3};
  read(id);
  ASSERT_TRUE(ended());
  EXPECT_EQ(ends[0].by, ConnectionEnd::By::kSlaveAbort);
  EXPECT_EQ(ends[0].words, "aborted by the slave: MSAC_C2: ABT_TO (timeout of the connection), no subnet, detail 3");
  EXPECT_EQ(results.back().outcome, AcyclicOutcome::kLost);
}

TEST_F(Class2, SilenceInEachStateProvokesTheSlavesTimers) {
  const std::vector<std::pair<ConnectionState, int>> cases = {
      {ConnectionState::kConnecting, 1}, {ConnectionState::kOpen, 2}, {ConnectionState::kBusy, 1}};
  for (const auto& [from, detail] : cases) {
    ConnectionParameters how = parameters();
    how.silent_from = from;
    const ConnectionId id = open(how);
    master.read(id, 0, 0, 1);
    ASSERT_TRUE(run_until([&, from = from] { return state(id) == from; }));
    const std::size_t before = telegrams.size(), ended_before = ends.size();
    run(3 * kT);
    for (std::size_t i = before; i < telegrams.size(); ++i) EXPECT_FALSE(telegrams[i].decoded.telegram.is_request());
    master.set_behaviour(id, Behaviour::kNormal);
    ASSERT_TRUE(ended(ended_before + 1));
    // The master's time has also expired if it had sent a request: it aborts first.
    if (from == ConnectionState::kOpen) {
      EXPECT_EQ(ends.back().by, ConnectionEnd::By::kSlaveAbort);
      EXPECT_EQ(ends.back().detail, detail);
    } else {
      EXPECT_EQ(ends.back().by, ConnectionEnd::By::kMaster);
      EXPECT_EQ(ends.back().instance_and_reason, 0x13);
    }
  }
}

TEST_F(Class2, APollInTimeAfterSilenceFetchesTheSlavesAbort) {
  ConnectionParameters how = parameters();
  how.silent_from = ConnectionState::kConnecting;
  const ConnectionId id = open(how);
  ASSERT_TRUE(run_until([&] { return state(id) == ConnectionState::kConnecting; }));
  run(kT + kT / 2);
  master.set_behaviour(id, Behaviour::kNormal);
  ASSERT_TRUE(ended());
  EXPECT_EQ(ends[0].by, ConnectionEnd::By::kSlaveAbort);
  EXPECT_EQ(ends[0].detail, 1);
}

TEST_F(Class2, PollsAloneDoNotKeepAConnection) {
  const ConnectionId id = connected();
  master.set_behaviour(id, Behaviour::kPollOnly);
  const Tick from = timeline.now();
  ASSERT_TRUE(ended());
  EXPECT_EQ(ends[0].detail, 2);
  EXPECT_GE(timeline.now() - from, 2 * kT - kTicksPerMs);
  EXPECT_LE(timeline.now() - from, 2 * kT + kTicksPerMs);
}

TEST_F(Class2, ARequestWhileOneIsOpenIsRefusedAndChangesNothing) {
  const ConnectionId id = connected();
  c2.channels[0].mailbox.busy_polls = 30;
  master.read(id, 1, 2, 4, keep());
  ASSERT_TRUE(run_until([&] { return state(id) == ConnectionState::kBusy; }));
  std::vector<FdlResult> answers;
  RawAcyclic raw;
  raw.pdu = {0x5E, 0, 0, 1};
  raw.done = [&](const FdlResult& result) { answers.push_back(result); };
  master.inject(id, raw);
  EXPECT_TRUE(last().positive());
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0].answer.function(), fc::kRr);
}

TEST_F(Class2, AWrongSsapAndNonsenseAreSentAsTheyAre) {
  const ConnectionId id = connected();
  std::vector<FdlResult> answers;
  RawAcyclic raw;
  raw.done = [&](const FdlResult& result) { answers.push_back(result); };
  raw.ssap = 51;
  raw.pdu = {0x48};
  master.inject(id, raw);
  raw.ssap = sap::kMs2Master;
  raw.dsap = 20;
  raw.pdu = {0xFF, 0xEE};
  master.inject(id, raw);
  ASSERT_TRUE(run_until([&] { return answers.size() == 2; }));
  EXPECT_EQ(answers[0].request.ssap, 51);
  EXPECT_EQ(answers[0].request.dsap, 0x30);
  EXPECT_EQ(answers[0].answer.function(), fc::kRs);
  EXPECT_EQ(answers[1].request.dsap, 20);
  EXPECT_EQ(answers[1].request.data, (Bytes{0xFF, 0xEE}));
  EXPECT_TRUE(read(id).positive());
}

TEST_F(Class2, WrongAnswersLeadToAnAbortWithItsReason) {
  const std::vector<std::pair<Bytes, int>> cases = {{{0x5F, 1, 2, 0}, 0x11}, {{0x57, 1, 2, 0}, 0x11},
                                                    {{0x33, 1, 2, 0}, 0x14}, {{0x5E, 9, 2, 0}, 0x14},
                                                    {{0x5E, 1, 2}, 0x14},    {{0x5E, 1, 2, 7, 0}, 0x14}};
  for (const auto& [answer, reason] : cases) {
    const ConnectionId id = connected();
    c2.channels[0].mailbox.user = [&answer = answer](const Bytes&) { return answer; };
    EXPECT_EQ(read(id).outcome, AcyclicOutcome::kWrongAnswer);
    const std::size_t aborts = c2.aborts.size();
    ASSERT_TRUE(run_until([&] { return c2.aborts.size() > aborts; }));
    EXPECT_EQ(c2.aborts.back(), (Bytes{0x58, 1, static_cast<std::uint8_t>(reason), 0}));
    ASSERT_TRUE(run_until([&] { return state(id) == ConnectionState::kClosed; }));
  }
}

TEST_F(Class2, AWrongInitiateAnswerIsAborted) {
  c2.initiate_answer = {0x5E, 0, 0, 0};
  open();
  ASSERT_TRUE(ended());
  EXPECT_EQ(ends[0].instance_and_reason, 0x11);
  c2.initiate_answer = {0x57, 0xF0};
  open();
  ASSERT_TRUE(ended(2));
  EXPECT_EQ(ends[1].instance_and_reason, 0x14);
}

TEST_F(Class2, ARefusedInitiateGivesItsCodes) {
  c2.initiate_answer = {0xD7, 0x80, 0xA9, 0};
  open();
  ASSERT_TRUE(ended());
  EXPECT_EQ(ends[0].by, ConnectionEnd::By::kRefused);
  EXPECT_EQ(ends[0].error_code_1, 0xA9);
  EXPECT_EQ(ends[0].words, "Initiate refused, application: feature not supported");
}

TEST_F(Class2, AUserWhoNeverAnswersLeadsToAnAbortForTime) {
  ConnectionParameters how = parameters();
  how.response_timeout = 3;
  const ConnectionId id = connected(how);
  c2.channels[0].mailbox.busy_polls = -1;
  const AcyclicResult result = read(id);
  EXPECT_EQ(result.outcome, AcyclicOutcome::kTimeout);
  EXPECT_GE(result.done_at - result.sent_at, 3 * kTimeUnit10ms);
  EXPECT_LE(result.done_at - result.sent_at, 3 * kTimeUnit10ms + kTicksPerMs);
  ASSERT_TRUE(ended());
  EXPECT_EQ(c2.aborts.back(), (Bytes{0x58, 1, 0x13, 0}));
}

TEST_F(Class2, AChannelThatIsGoneAndASlaveThatIsGoneEndTheConnection) {
  const ConnectionId id = connected();
  c2.channels[0].state = FakeC2::Channel::State::kFree;
  read(id);
  EXPECT_EQ(ends.back().by, ConnectionEnd::By::kNoChannel);
  const ConnectionId second = connected();
  slave.acyclic_silent = true;
  read(second);
  EXPECT_EQ(ends.back().by, ConnectionEnd::By::kNoAnswer);
}

TEST_F(Class2, AClosedConnectionCanBeOpenedAgain) {
  const ConnectionId id = connected();
  master.abort(id);
  ASSERT_TRUE(ended());
  master.connect(id);
  EXPECT_TRUE(run_until([&] { return state(id) == ConnectionState::kOpen; }));
  EXPECT_TRUE(read(id).positive());
}

TEST_F(Class2, StoppingTheMasterClosesItsConnections) {
  const ConnectionId id = connected();
  master.stop();
  run(kTicksPerMs);
  EXPECT_EQ(state(id), ConnectionState::kClosed);
  EXPECT_EQ(ends.at(0).by, ConnectionEnd::By::kStopped);
  const std::size_t before = telegrams.size();
  run(kT);
  EXPECT_EQ(telegrams.size(), before);
}

TEST_F(Class2, PollsKeepTheirInterval) {
  ConnectionParameters how = parameters();
  how.poll_interval_us = 500;
  const ConnectionId id = connected(how);
  c2.channels[0].mailbox.busy_polls = 10;
  const AcyclicResult result = read(id);
  EXPECT_EQ(result.polls, 10);
  EXPECT_GE(result.done_at - result.sent_at, 10 * 500 * kTicksPerUs);
}

TEST_F(Class2, ParametersOutOfTheirRangeAreRefused) {
  ConnectionParameters how = parameters();
  how.slave = 127;
  EXPECT_THROW(master.add_connection(how), std::invalid_argument);
  how = parameters();
  how.features = {1};
  EXPECT_THROW(master.add_connection(how), std::invalid_argument);
  EXPECT_THROW(master.connect(77), std::out_of_range);
}

/// The plant: a class-1 master in data exchange with the slave, a class-2 master with two channels, the token between
/// them.
TEST_F(Class2, BesideAClassOneMasterNothingIsLostOrMixedUp) {
  MasterConfig cyclic = config(1);
  cyclic.bus.ring = true;
  cyclic.bus.gap_factor = 1;
  cyclic.bus.highest_address = 8;
  Master1 class1(segment, cyclic);
  timeline.add(class1);
  SlaveParameters exchange;
  exchange.address = 3;
  exchange.ident = 0x0B9A;
  exchange.cfg = {0x11, 0x21};
  exchange.input_length = exchange.output_length = 2;
  class1.add_slave(exchange);
  master.stop();
  timeline.run_until(timeline.now());
  class1.start();
  master.start();
  const ConnectionId first = connected(), second = connected();
  ASSERT_TRUE(run_until([&] { return class1.slave(3).state == SlaveState::kDataExchange; }));
  int done = 0, wrong = 0;
  for (int i = 0; i < 200; ++i) {
    const auto length = static_cast<std::uint8_t>(i);
    const AcyclicCallback check = [&, length](const AcyclicResult& result) {
      ++done;
      wrong += result.positive() && result.data.size() == length ? 0 : 1;
    };
    master.read(i % 2 == 0 ? first : second, 0, 0, length, check);
  }
  const std::uint64_t before = class1.slave(3).counters.data_exchanges;
  ASSERT_TRUE(run_until([&] { return done == 200; }));
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(class1.slave(3).counters.data_exchanges, before + 200);
  EXPECT_EQ(class1.slave(3).counters.parameterisations, 1U);
}

}  // namespace
}  // namespace dsdpv1::bus
