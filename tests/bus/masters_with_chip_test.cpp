// The masters of bus/ with the chip: a class-1 master with C1, a class-2 master with two channels, the token between
// them.
#include <gmock/gmock.h>

#include <algorithm>

#include "bus/master/master1.hpp"
#include "bus/master/master2.hpp"
#include "bus/monitor/monitor.hpp"
#include "tests/bus/fake_acyclic.hpp"
#include "tests/conformance/dpv1_side.hpp"

namespace dsdpv1::bus {
namespace {

using conformance::Area;
using conformance::kC1Area;
using conformance::kC2Area;

constexpr std::uint8_t kChip = 5;
constexpr std::uint16_t kShortSendTimeout = 2;  // 20 ms: F and U; I is 40 ms
constexpr Tick kUserPeriod = 30 * kTicksPerUs;

struct MastersWithChip : conformance::Dpv1Test {
  void SetUp() override {
    bench.power_on();
    bench.enable_dpv1(true);
    ASSERT_TRUE(bench.initialise());
    bench.find_baud(0);
    bench.timeline.add(class1);
    bench.timeline.add(class2);
    bench.timeline.add(monitor);
    monitor.on_flag = [this](const Flag& flag) {
      if (flag.kind != FlagKind::kUnanswered) flags.push_back(format_line(flag));
    };
    SlaveParameters slave;
    slave.address = kChip;
    slave.ident = 0x0CC9;
    slave.cfg = {0x11, 0x21};
    slave.input_length = slave.output_length = 2;
    slave.dpv1 = true;
    class1.add_slave(slave);
    class2.on_end = [this](Tick, ConnectionId, const ConnectionEnd& end) { ends.push_back(end); };
    class1.start();
    class2.start();
    ASSERT_TRUE(serve_until([this] { return class1.slave(kChip).state == SlaveState::kDataExchange; }));
  }
  static MasterConfig config(std::uint8_t address) {
    MasterConfig config;
    config.name = "master " + std::to_string(address);
    config.address = address;
    config.bus.ring = true;
    config.bus.highest_address = 8;
    return config;
  }
  ConnectionId connected(std::optional<ConnectionState> silent_from = {}) {
    ConnectionParameters how;
    how.slave = kChip;
    how.send_timeout = kShortSendTimeout;
    how.response_timeout = 3 * kShortSendTimeout;
    how.silent_from = silent_from;
    const ConnectionId id = class2.add_connection(how);
    class2.connect(id);
    const ConnectionState goal = silent_from.value_or(ConnectionState::kOpen);
    if (goal == ConnectionState::kBusy) class2.read(id, 0, 0, 1);
    EXPECT_TRUE(serve_until([&] { return class2.connection(id).state() == goal; }));
    return id;
  }
  /// The user checks for requests and answers each at once.
  void serve() {
    for (const Area& area : {kC1Area, kC2Area}) {
      const Bytes request = fetch(area);
      if (!request.empty() && user_answers) give(area, test::obliging_user(request));
    }
  }
  bool serve_until(const std::function<bool()>& condition, Tick limit = 400 * kTicksPerMs) {
    const Tick end = bench.now() + limit;
    while (!condition() && bench.now() < end) {
      bench.run_for(kUserPeriod);
      serve();
    }
    return condition();
  }
  /// Lets the master poll after a silence of `quiet`; returns how the chip ends the connection.
  ConnectionEnd end_after(ConnectionId id, Tick quiet) {
    bench.run_for(quiet);
    class2.set_behaviour(id, Behaviour::kNormal);
    EXPECT_TRUE(serve_until([this] { return !ends.empty(); }));
    return ends.empty() ? ConnectionEnd{} : ends.back();
  }

  Master1 class1{bench.segment, config(2)};
  Master2 class2{bench.segment, config(1)};
  Monitor monitor{bench.segment};
  bool user_answers = true;
  std::vector<std::string> flags;
  std::vector<ConnectionEnd> ends;
};

TEST_F(MastersWithChip, C1AndTwoChannelsBesideTheCyclicExchangeNothingIsLostOrMixedUp) {
  const ConnectionId first = connected(), second = connected();
  EXPECT_EQ(class2.connection(first).granted().sap, 0x30);
  EXPECT_EQ(class2.connection(second).granted().sap, 0x2F);
  constexpr int kOperations = 60;
  int done = 0, wrong = 0;
  for (int i = 0; i < kOperations; ++i) {
    const auto slot = static_cast<std::uint8_t>(i), length = static_cast<std::uint8_t>(i * 4);
    const AcyclicCallback check = [&, length](const AcyclicResult& result) {
      ++done;
      const bool write = result.request.function == function_num::kWrite;
      wrong += result.positive() && result.data.size() == (write ? 0U : length) ? 0 : 1;
    };
    class1.c1_read(kChip, slot, 0x11, length, check);
    class2.read(first, slot, 0x22, length, check);
    class2.write(first, slot, 0x33, Bytes(length, 0x77), check);
    class2.transport(second, slot, 0x44, Bytes(length, 0x55), check);
  }
  const std::uint64_t before = class1.slave(kChip).counters.data_exchanges;
  ASSERT_TRUE(serve_until([&] { return done == 4 * kOperations; })) << done;
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(class1.slave(kChip).counters.data_exchanges, before + kOperations);
  EXPECT_EQ(class1.slave(kChip).counters.parameterisations, 1U);
  EXPECT_TRUE(ends.empty());
  EXPECT_TRUE(flags.empty()) << flags.front();
  EXPECT_GT(monitor.rotations().at(1).count, 100U);
  EXPECT_GT(monitor.rotations().at(2).count, 100U);
}

TEST_F(MastersWithChip, IdleKeepsTheChannelAlive) {
  const ConnectionId id = connected();
  bench.run_ms(100);
  EXPECT_EQ(class2.connection(id).state(), ConnectionState::kOpen);
  EXPECT_TRUE(ends.empty());
}

TEST_F(MastersWithChip, SilenceAfterTheImmediateAnswerEndsF) {
  const ConnectionEnd end = end_after(connected(ConnectionState::kConnecting), 25 * kTicksPerMs);
  EXPECT_EQ(end.words, "aborted by the slave: MSAC_C2: ABT_TO (timeout of the connection), no subnet");
  EXPECT_EQ(bench.last(profibus::Reason::kC2Timeout).b, 1);
}

TEST_F(MastersWithChip, SilenceInAnOpenConnectionEndsI) {
  const ConnectionEnd end = end_after(connected(ConnectionState::kOpen), 45 * kTicksPerMs);
  EXPECT_EQ(end.words, "aborted by the slave: MSAC_C2: ABT_TO (timeout of the connection), no subnet");
  EXPECT_EQ(bench.last(profibus::Reason::kC2Timeout).b, 2);
}

TEST_F(MastersWithChip, AUserWhoDoesNotAnswerEndsU) {
  const ConnectionId id = connected();
  user_answers = false;
  AcyclicResult lost;
  class2.read(
      id, 0, 0, 1, [&](const AcyclicResult& result) { lost = result; });
  ASSERT_TRUE(serve_until([this] { return !ends.empty(); }));
  EXPECT_EQ(ends[0].words, "aborted by the slave: MSAC_C2: ABT_TO (timeout of the connection), no subnet");
  EXPECT_EQ(bench.last(profibus::Reason::kC2Timeout).b, 3);
  EXPECT_EQ(lost.outcome, AcyclicOutcome::kLost);
}

TEST_F(MastersWithChip, PollsAloneDoNotKeepAConnection) {
  const ConnectionId id = connected();
  class2.set_behaviour(id, Behaviour::kPollOnly);
  ASSERT_TRUE(serve_until([this] { return !ends.empty(); }));
  EXPECT_EQ(bench.last(profibus::Reason::kC2Timeout).b, 2);
}

TEST_F(MastersWithChip, AThirdConnectionIsRefusedAndAnAbortMakesRoom) {
  const ConnectionId first = connected();
  connected();
  ConnectionParameters how;
  how.slave = kChip;
  const ConnectionId third = class2.add_connection(how);
  class2.connect(third);
  ASSERT_TRUE(serve_until([this] { return !ends.empty(); }));
  EXPECT_EQ(ends[0].by, ConnectionEnd::By::kRefused);
  class2.abort(first);
  ASSERT_TRUE(serve_until([this] { return ends.size() == 2; }));
  class2.connect(third);
  EXPECT_TRUE(serve_until([&] { return class2.connection(third).state() == ConnectionState::kOpen; }));
  EXPECT_EQ(class2.connection(third).granted().sap, 0x30);
}

TEST_F(MastersWithChip, TheLongFormOfAddAddrComesBackExchanged) {
  ConnectionParameters how;
  how.slave = kChip;
  how.add_addr = long_add_addr({1, {0xA0, 0xA1}}, {0, {0xB0}});
  const ConnectionId id = class2.add_connection(how);
  class2.connect(id);
  ASSERT_TRUE(serve_until([&] { return class2.connection(id).state() == ConnectionState::kOpen; }));
  EXPECT_EQ(class2.connection(id).granted().initiate_answer,
            (Bytes{0x57, 0xF0, 1, 0, 0, 0, 0, 0, 0, 1, 1, 2, 0xB0, 0xA0, 0xA1}));
}

TEST_F(MastersWithChip, ARequestInFrontOfTheInitiateAnswerIsASequenceError) {
  const ConnectionId id = connected(ConnectionState::kConnecting);
  RawAcyclic raw;
  raw.pdu = {0x5E, 0, 0, 1};
  class2.inject(id, raw);
  raw.pdu = {};  // E5, and the next poll gets the abort (V11)
  class2.inject(id, raw);
  ASSERT_TRUE(serve_until([this] { return !ends.empty(); }));
  EXPECT_EQ(ends[0].words, "aborted by the slave: MSAC_C2: ABT_SE (sequence error), no subnet");
}

TEST_F(MastersWithChip, TheChipRefusesWhatTheMasterAsksWrongly) {
  AcyclicResult result;
  AcyclicRequest wrong = bus::read_request(0, 0, 4);
  wrong.function = 0x51;  // transport is C2's
  class1.c1_request(
      kChip, wrong, [&](const AcyclicResult& each) { result = each; });
  ASSERT_TRUE(serve_until([&] { return result.done_at != 0; }));
  EXPECT_EQ(result.error_code_1, 0xA9);
}

}  // namespace
}  // namespace dsdpv1::bus
