#include "bus/master/master1.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "bus/monitor/monitor.hpp"
#include "tests/bus/fake_slave.hpp"

namespace dsdpv1::bus {
namespace {

using test::FakeDpSlave;
using testing::ElementsAre;

SlaveParameters parameters(std::uint8_t address) {
  SlaveParameters slave;
  slave.address = address;
  slave.ident = 0x0B9A;
  slave.cfg = {0x11, 0x21};
  slave.input_length = slave.output_length = 2;
  return slave;
}

/// A master, slave 3 and a monitor that must flag nothing unless a test expects it.
struct Bench {
  explicit Bench(int baud_index = 0, Personality personality = Personality::kHighAlways, BusParameters bus = fast())
      : slave(segment, timeline, 3), master(segment, config(baud_index, personality, bus)), monitor(segment) {
    slave.station.set_baud(baud_index);
    monitor.set_baud(baud_index);
    timeline.add(master);
    timeline.add(monitor);
    master.add_slave(parameters(3));
    master.on_state = [this](Tick, std::uint8_t, SlaveState, SlaveState to) { states.push_back(to); };
    monitor.on_flag = [this](const Flag& flag) { flags.push_back(format_line(flag)); };
    monitor.on_telegram = [this](const WireTelegram& telegram) { wire.push_back(telegram); };
  }
  static BusParameters fast() {
    BusParameters bus;
    bus.gap_factor = 0;
    return bus;
  }
  static MasterConfig config(int baud_index, Personality personality, const BusParameters& bus) {
    MasterConfig config;
    config.baud = baud_index;
    config.personality = personality;
    config.bus = bus;
    return config;
  }
  void run_bits(Tick bits) { timeline.run_until(timeline.now() + bits * baud(master.baud()).bit); }
  SlaveState state() const { return master.slave(3).state; }
  void bring_up() {
    master.start();
    run_bits(40'000);
    ASSERT_EQ(state(), SlaveState::kDataExchange);
  }

  Segment segment;
  Timeline timeline;
  FakeDpSlave slave;
  Master1 master;
  Monitor monitor;
  std::vector<SlaveState> states;
  std::vector<std::string> flags;
  std::vector<WireTelegram> wire;
};

struct MasterTest : testing::Test, Bench {};

using Case = std::tuple<int, Personality>;
struct BringUp : testing::TestWithParam<Case> {
  BringUp() : bench(std::get<0>(GetParam()), std::get<1>(GetParam())) {}
  Bench bench;
};
INSTANTIATE_TEST_SUITE_P(BaudsAndPersonalities, BringUp,
                         testing::Combine(testing::Range(0, kBaudCount),
                                          testing::Values(Personality::kHighAlways, Personality::kClassic)));

TEST_P(BringUp, ReachesDataExchangeAndTheMonitorFlagsNothing) {
  bench.bring_up();
  EXPECT_TRUE(bench.flags.empty()) << bench.flags.front();
  EXPECT_GT(bench.master.slave(3).counters.data_exchanges, 5U);
  EXPECT_EQ(bench.master.slave(3).inputs, bench.slave.inputs);
  EXPECT_EQ(bench.slave.cfg, (Bytes{0x11, 0x21}));
  EXPECT_EQ(bench.slave.repetitions, 0);
}

TEST_P(BringUp, EveryRequestKeepsSyn) {
  bench.bring_up();
  for (std::size_t i = 1; i < bench.wire.size(); ++i) {
    if (bench.wire[i].decoded.telegram.is_response()) continue;
    EXPECT_GE(bench.wire[i].start - bench.wire[i - 1].end, kSynBits * baud(bench.master.baud()).bit);
  }
}

TEST_F(MasterTest, IsSilentUntilStartedThenListensAndClaimsTheTokenTwice) {
  run_bits(50'000);
  EXPECT_TRUE(wire.empty());
  const Tick started = timeline.now();
  master.start();
  run_bits(20'000);
  ASSERT_GE(wire.size(), 2U);
  EXPECT_EQ(wire[0].start - started, 8 * 1000 * baud(0).bit);  // (6 + 2 x 1) x T_SL
  EXPECT_EQ(wire[0].decoded.telegram, make_token(1, 1));
  EXPECT_EQ(wire[1].decoded.telegram, make_token(1, 1));
}

TEST_F(MasterTest, GoesThroughTheStatesInOrder) {
  bring_up();
  EXPECT_THAT(states, ElementsAre(SlaveState::kDiagnose, SlaveState::kSetPrm, SlaveState::kChkCfg,
                                  SlaveState::kAwaitReady, SlaveState::kDataExchange));
}

TEST_F(MasterTest, WaitsForAUserWhoJudges) {
  slave.judge_requests = 5;
  bring_up();
  EXPECT_EQ(master.slave(3).counters.parameterisations, 1U);
}

TEST_F(MasterTest, ParameterisesAnewAfterACfgFault) {
  slave.cfg_fault = true;
  bring_up();
  EXPECT_EQ(master.slave(3).counters.parameterisations, 2U);
}

TEST_F(MasterTest, RepeatsUnansweredRequestsWithTheSameFcb) {
  bring_up();
  slave.silent_for = 2;
  run_bits(5000);
  EXPECT_EQ(slave.repetitions, 2);
  EXPECT_EQ(master.slave(3).counters.retries, 2U);
  EXPECT_EQ(master.slave(3).counters.timeouts, 2U);
  EXPECT_EQ(state(), SlaveState::kDataExchange);
  EXPECT_EQ(flags.size(), 2U);  // unanswered
}

TEST_F(MasterTest, RepeatsAfterWrongAnswers) {
  bring_up();
  slave.broken_for = 1;
  run_bits(5000);
  EXPECT_EQ(slave.repetitions, 1);
  EXPECT_EQ(master.slave(3).counters.errors, 1U);
}

TEST_F(MasterTest, ALostSlaveIsTriedOnceACycleAndComesBack) {
  bring_up();
  segment.plug(slave.station.station, timeline.now(), false);
  run_bits(20'000);
  EXPECT_EQ(state(), SlaveState::kOffline);
  slave.state = FakeDpSlave::State::kWaitPrm;
  segment.plug(slave.station.station, timeline.now(), true);
  run_bits(20'000);
  EXPECT_EQ(state(), SlaveState::kDataExchange);
}

TEST_F(MasterTest, AnOfflineSlaveCostsTheOthersOnePollACycle) {
  master.add_slave(parameters(20));
  master.add_slave(parameters(21));
  master.start();
  run_bits(60'000);
  const std::uint64_t exchanges = master.slave(3).counters.data_exchanges;
  const std::uint64_t cycles = master.cycles();
  const std::size_t before = wire.size();
  run_bits(200'000);
  std::uint64_t polls = 0;
  for (std::size_t i = before; i < wire.size(); ++i) {
    const std::uint8_t da = wire[i].decoded.telegram.da;
    polls += da == 20 || da == 21 ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(master.slave(3).counters.data_exchanges - exchanges),
              static_cast<double>(master.cycles() - cycles), 1.0);
  // Each poll of the cycle is sent once and repeated four times at 12 Mbit/s.
  EXPECT_LE(polls, 5 * (master.cycles() - cycles + 1));
}

TEST_F(MasterTest, HighPriorityAnswersLeadToADiagnosis) {
  bring_up();
  const std::uint64_t before = master.slave(3).counters.diagnoses;
  slave.high_priority = true;
  run_bits(3000);
  EXPECT_EQ(master.slave(3).counters.diagnoses, before + 1);
  EXPECT_FALSE(slave.high_priority);
}

TEST_F(MasterTest, StaticDiagnosisStopsDataExchangeUntilItIsGone) {
  bring_up();
  slave.extra_status_2 = 0x02;
  slave.high_priority = true;
  run_bits(2000);
  const std::uint64_t before = master.slave(3).counters.data_exchanges;
  run_bits(5000);
  EXPECT_EQ(master.slave(3).counters.data_exchanges, before);
  slave.extra_status_2 = 0;
  run_bits(5000);
  EXPECT_GT(master.slave(3).counters.data_exchanges, before);
}

TEST_F(MasterTest, ParameterisesAnewWhenTheSlaveAsksForIt) {
  bring_up();
  slave.state = FakeDpSlave::State::kWaitPrm;
  run_bits(10'000);
  EXPECT_EQ(state(), SlaveState::kDataExchange);
  EXPECT_EQ(master.slave(3).counters.parameterisations, 2U);
}

TEST_F(MasterTest, InputsAndOutputsAreExchangedAndChangesReported) {
  bring_up();
  int changes = 0;
  master.on_inputs = [&](Tick, std::uint8_t address) { changes += address == 3 ? 1 : 0; };
  slave.inputs = {7, 8};
  master.set_outputs(3, {5, 6});
  run_bits(3000);
  EXPECT_EQ(changes, 1);
  EXPECT_EQ(master.slave(3).inputs, (Bytes{7, 8}));
  EXPECT_EQ(slave.outputs, (Bytes{5, 6}));
}

TEST_F(MasterTest, ClearIsAnnouncedAndSendsZeros) {
  bring_up();
  master.set_outputs(3, {5, 6});
  run_bits(3000);
  master.clear();
  run_bits(3000);
  EXPECT_EQ(slave.outputs, (Bytes{0, 0}));
  const auto is_clear = [](const Telegram& t) { return t.da == kBroadcast && t.data == Bytes{0x02, 0x00}; };
  EXPECT_EQ(std::count_if(slave.requests.begin(), slave.requests.end(), is_clear), 1);
  master.operate();
  run_bits(3000);
  EXPECT_EQ(slave.outputs, (Bytes{5, 6}));
}

TEST_F(MasterTest, CommandsAreCarriedOutInTheirOrderWithTheirAnswers) {
  bring_up();
  std::vector<std::pair<std::string, FdlResult>> answers;
  const auto note = [&](const char* what) {
    return [&answers, what](const FdlResult& result) { answers.emplace_back(what, result); };
  };
  master.global_control(global_control::kSync | global_control::kFreeze, 0x01, kBroadcast, note("gc"));
  master.read_inputs(3, note("inputs"));
  master.read_outputs(3, note("outputs"));
  master.get_cfg(3, note("cfg"));
  master.slave_diag(3, note("diag"));
  master.fdl_status(3, note("status"));
  master.set_slave_address(3, 9, 0x0B9A, true, note("address"));
  run_bits(20'000);
  ASSERT_EQ(answers.size(), 7U);
  EXPECT_EQ(answers[0].second.outcome, FdlOutcome::kSent);
  EXPECT_EQ(answers[0].second.request.data, (Bytes{0x28, 0x01}));
  EXPECT_EQ(answers[1].second.answer.data, slave.inputs);
  EXPECT_EQ(answers[2].second.answer.data, slave.outputs);
  EXPECT_EQ(answers[3].second.answer.data, (Bytes{0x11, 0x21}));
  EXPECT_EQ(answers[4].second.answer.data.size(), 6U);
  EXPECT_EQ(answers[5].second.answer.fc, 0x00);
  EXPECT_EQ(answers[6].second.request.data, (Bytes{9, 0x0B, 0x9A, 0xFF}));
  EXPECT_EQ(state(), SlaveState::kDataExchange);
  EXPECT_TRUE(flags.empty());
}

TEST_F(MasterTest, ReleaseUnlocksAndActivateBringsUpAgain) {
  bring_up();
  master.release(3);
  run_bits(5000);
  EXPECT_EQ(state(), SlaveState::kReleased);
  EXPECT_EQ(slave.prm[0], 0x40);
  const std::size_t requests = slave.requests.size();
  run_bits(5000);
  EXPECT_EQ(slave.requests.size(), requests);
  master.activate(3);
  run_bits(10'000);
  EXPECT_EQ(state(), SlaveState::kDataExchange);
}

TEST_F(MasterTest, StopIsSilenceAtOnceAndStartBringsUpAnew) {
  bring_up();
  master.stop();
  run_bits(10);
  const std::size_t before = wire.size();
  run_bits(100'000);
  EXPECT_LE(wire.size(), before + 1);  // at most the telegram cut off
  EXPECT_FALSE(master.running());
  master.start();
  run_bits(40'000);
  EXPECT_EQ(state(), SlaveState::kDataExchange);
  EXPECT_EQ(master.slave(3).counters.parameterisations, 2U);
}

TEST_F(MasterTest, ChangesTheBaudRateInOperation) {
  bring_up();
  master.change_baud(4);
  run_bits(1000);
  slave.station.set_baud(4);
  monitor.set_baud(4);
  EXPECT_EQ(master.baud(), 4);
  run_bits(20'000);
  EXPECT_EQ(state(), SlaveState::kDataExchange);
  EXPECT_THROW(master.change_baud(10), std::out_of_range);
}

TEST_F(MasterTest, RawTelegramsWithFaults) {
  bring_up();
  std::vector<FdlResult> results;
  const auto note = [&](const FdlResult& result) { results.push_back(result); };
  const Bytes status = encode(make_telegram(3, 1, 0x49));
  WireFaults faults;
  faults.wrong_parity_at = 1;
  master.send_raw(status, {}, true, note);
  master.send_raw(status, faults, true, note);
  run_bits(10'000);
  ASSERT_EQ(results.size(), 2U);
  EXPECT_TRUE(results[0].answered());
  EXPECT_EQ(results[1].outcome, FdlOutcome::kNoAnswer);
  EXPECT_EQ(state(), SlaveState::kDataExchange);
}

TEST(Master, TheLiveListIsFilledByFdlStatusPolls) {
  BusParameters bus;
  bus.gap_factor = 1;
  bus.highest_address = 8;
  Bench bench(0, Personality::kHighAlways, bus);
  test::FakeStation other(bench.segment, bench.timeline, "master 7");
  other.script = [](const Telegram& telegram) -> std::optional<test::Reply> {
    if (telegram.da != 7) return std::nullopt;
    return test::Reply{encode(make_telegram(1, 7, 0x20))};
  };
  bench.master.start();
  bench.run_bits(60'000);
  EXPECT_EQ(bench.master.live(3), LiveState::kPassive);
  EXPECT_EQ(bench.master.live(5), LiveState::kAbsent);
  EXPECT_EQ(bench.master.live(7), LiveState::kActive);
  EXPECT_EQ(bench.master.live(99), LiveState::kUnknown);
}

TEST(Master, KeepsTheMinSlaveInterval) {
  BusParameters bus = Bench::fast();
  bus.min_slave_interval_us = 500;
  Bench bench(0, Personality::kHighAlways, bus);
  bench.bring_up();
  EXPECT_EQ(bench.master.cycle_time(), 500 * kTicksPerUs);
}

TEST(Master, TheGreatestMinSlaveIntervalOfItsSlavesCounts) {
  const auto cycle_time = [](std::optional<std::int64_t> given) {
    BusParameters bus = Bench::fast();
    bus.min_slave_interval_us = given;
    Bench bench(0, Personality::kHighAlways, bus);
    for (const int address : {4, 5}) {
      SlaveParameters slave = parameters(static_cast<std::uint8_t>(address));
      slave.min_slave_interval_us = address == 4 ? 700 : 400;
      bench.master.add_slave(slave);  // absent, but its setting counts
    }
    bench.master.start();
    bench.run_bits(200'000);
    EXPECT_EQ(bench.state(), SlaveState::kDataExchange);
    return bench.master.cycle_time() / kTicksPerUs;
  };
  EXPECT_EQ(cycle_time(std::nullopt), 700);
  EXPECT_EQ(cycle_time(900), 900);
  EXPECT_LT(cycle_time(0), 600) << "0: as fast as the bus allows";
}

TEST(Master, WithoutAnySlaveTimeStillPasses) {
  Segment segment;
  Timeline timeline;
  MasterConfig config;
  config.bus.token = false;
  config.bus.gap_factor = 0;
  Master1 master(segment, config);
  timeline.add(master);
  master.start();
  timeline.run_until(kTicksPerMs);
  EXPECT_GT(master.cycles(), 10U);
}

TEST_F(MasterTest, RefusesAddressesUsedTwiceAndUnknownOnes) {
  EXPECT_THROW(master.add_slave(parameters(3)), std::invalid_argument);
  EXPECT_THROW(master.add_slave(parameters(1)), std::invalid_argument);
  EXPECT_THROW(master.set_outputs(4, {}), std::out_of_range);
  EXPECT_THAT(master.slave_addresses(), ElementsAre(3));
  MasterConfig config;
  config.address = 126;
  EXPECT_THROW(Master1(segment, config), std::invalid_argument);
}

TEST(Master, TwoRunsAreIdentical) {
  std::vector<std::string> lines[2];
  for (auto& log : lines) {
    Bench bench;
    bench.slave.silent_for = 3;
    bench.bring_up();
    for (const WireTelegram& telegram : bench.wire) log.push_back(format_line(telegram));
  }
  EXPECT_EQ(lines[0], lines[1]);
}

}  // namespace
}  // namespace dsdpv1::bus
