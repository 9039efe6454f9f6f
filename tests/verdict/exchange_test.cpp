// The implied expectation of a slave in a master's list, on the bench.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "io/input/input_error.hpp"
#include "tb/bench/bench.hpp"
#include "tb/bench/exchange_watch.hpp"
#include "tb/bench/verdict.hpp"

namespace dsdpv1 {
namespace {

using testing::HasSubstr;

/// A slave that reaches data exchange at 2 ms; `more`: further parts of the scenario; `master_slave` and `user_cpu`:
/// further keys.
struct Given {
  std::string more = {}, master_slave = {}, user_cpu = {}, init = {};
  std::string end = "8ms";
};

tb::scenario::Scenario scenario_of(const Given& given) {
  const std::string text =
      "name: x\nbaud: 12M\nend: " + given.end +
      "\nslaves:\n  - {name: io, address: 5, init: {ident: 0x0CC9, max_inputs: 2, max_outputs: 2, cfg: \"31\"" +
      given.init + "}, user_cpu: {" + given.user_cpu +
      "}}\nmasters:\n  - {name: plc, address: 2, slaves: [{slave: io, outputs: \"01 02\"" + given.master_slave +
      "}]}\n" + given.more;
  return tb::scenario::parse(text, "x.yaml");
}

tb::RunResult run(const Given& given) {
  const tb::scenario::Scenario scenario = scenario_of(given);
  tb::Bench bench(scenario, {}, tb::make_pin_execution());
  return bench.run([](tb::Tick) { return true; });
}

/// Text of the one implied expectation.
tb::ExpectationResult implied(const tb::RunResult& result) {
  const bool one = result.expectations.size() == 1 && result.expectations[0].implied;
  EXPECT_TRUE(one) << result.expectations.size();
  return one ? result.expectations[0] : tb::ExpectationResult{};
}

void expect_passes(const Given& given) {
  const tb::RunResult result = run(given);
  EXPECT_EQ(tb::verdict(result), tb::Verdict::kPassed) << implied(result).seen;
}

void expect_fails(const Given& given, const std::string& seen) {
  const tb::RunResult result = run(given);
  EXPECT_EQ(tb::verdict(result), tb::Verdict::kFailed);
  EXPECT_THAT(implied(result).seen, HasSubstr(seen));
}

TEST(ImpliedExchange, IsReachedAndKept) {
  const tb::RunResult result = run({});
  EXPECT_TRUE(implied(result).passed) << implied(result).seen;
  EXPECT_THAT(implied(result).text, HasSubstr("io comes to data exchange with plc and stays to the end"));
  EXPECT_EQ(implied(result).line, 7);
  EXPECT_EQ(tb::words(result), "PASSED");
}

TEST(ImpliedExchange, OfAnotherIdentIsNeverReached) {
  expect_fails({"", ", ident: 0xC90C"}, "never, WAIT_PRM at the end; plc: ident is 0x0CC9, expected 0xC90C");
}

TEST(ImpliedExchange, OfAnotherConfigurationIsNeverReached) {
  expect_fails({"", ", cfg: \"32\""}, "never, WAIT_CFG at the end; plc: Cfg_Fault; CFG_IO_LENGTH since ");
}

TEST(ImpliedExchange, WithoutAVerdictOfTheUserIsNeverReachedAndTheUserOwesIt) {
  expect_fails({"", "", "judge_prm: never", ", prm_mode: 2"}, "PRM_TO_USER since 1");  // us: the first Set_Prm
}

TEST(ImpliedExchange, WithAnotherAddressIsNeverReached) { expect_fails({"", ", address: 6"}, "never, "); }

TEST(ImpliedExchange, IsNotReachedInAShortRun) { expect_fails({"", "", "", "", "1ms"}, "never, "); }

TEST(ImpliedExchange, IsNotExpectedWithExpectNone) {
  const tb::RunResult result = run({"expect: none\n", ", ident: 0xC90C"});
  EXPECT_TRUE(result.expectations.empty());
  EXPECT_EQ(tb::verdict(result), tb::Verdict::kNothingJudged);
}

TEST(ImpliedExchange, ExpectIsAListOrNone) {
  try {
    run({"expect: nothing\n"});
    FAIL() << "not refused";
  } catch (const tb::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("x.yaml:8: expect is \"nothing\", expected a list or none"));
  }
}

TEST(ImpliedExchange, IsNotExpectedWhereTheScenarioSaysOtherwise) {
  const tb::RunResult result = run({"expect:\n  - {slave: io, dp_state: wait_prm}\n", ", ident: 0xC90C"});
  ASSERT_EQ(result.expectations.size(), 1U);
  EXPECT_FALSE(result.expectations[0].implied);
  EXPECT_EQ(tb::verdict(result), tb::Verdict::kPassed);
}

TEST(ImpliedExchange, StaysExpectedBesideOtherExpectations) {
  const tb::RunResult result = run({"expect:\n  - {slave: io, event: PRM_IDENT}\n", ", ident: 0xC90C"});
  ASSERT_EQ(result.expectations.size(), 2U);
  EXPECT_EQ(tb::verdict(result), tb::Verdict::kFailed);
}

// --- the script

/// A master that stops cuts off its telegram; a user that pauses serves nothing.
const std::string kCut =
    "allow:\n  - {event: BUS_CHARACTER_ERROR}\n  - {event: BUS_TELEGRAM_ERROR}\n  - {event: OUTPUTS_FETCHED}\n  - "
    "{event: INPUTS_RENEWED}\n";

TEST(ImpliedExchange, IsNotJudgedToTheEndWhenTheScriptKeepsTheSlaveAway) {
  for (const char* action : {"do: unplug, slave: io", "do: stop_master", "do: reset_chip, slave: io, for: 100ms",
                             "do: pause_user, slave: io, for: 1s"}) {
    const tb::RunResult result =
        run({std::string("script:\n  - {at: 4ms, ") + action + "}\n" + kCut, ", watchdog: 1ms"});
    EXPECT_EQ(tb::verdict(result), tb::Verdict::kPassed) << action << implied(result).seen;
    EXPECT_TRUE(implied(result).left_out || implied(result).passed) << action;
  }
}

/// The slave is in data exchange at 1121 us, its master knows at 1164 us. The telegram is a Set_Prm with a wrong ident.
TEST(ImpliedExchange, MayBeLeftByATelegramBetweenTheStepsOfSlaveAndMaster) {
  for (const char* at : {"1125us", "1140us", "1160us", "1170us"})
    expect_passes({std::string("script: [{at: ") + at +
                   ", do: telegram, bytes: \"68 0C 0C 68 85 82 6D 3D 3E 80 00 00 0B 0C C8 00 4E 16\"}]\n"});
}

TEST(ImpliedExchange, MustHaveBeenThereBeforeTheScriptKeepsTheSlaveAway) {
  for (const char* action : {"do: unplug, slave: io", "do: stop_master", "do: reinitialise, slave: io, cfg: \"32\""})
    expect_fails({std::string("script:\n  - {at: 7ms, ") + action + "}\n" + kCut, ", ident: 0xC90C"}, "never, ");
}

TEST(ImpliedExchange, MustComeBackAfterAReinitialisation) {
  expect_passes({"script:\n  - {at: 4ms, do: reinitialise, slave: io}\nallow:\n  - {event: INIT_REPEATED}\n"});
  expect_fails({"script:\n  - {at: 4ms, do: reinitialise, slave: io, new_address: 6}\n"}, "at the end");
}

/// Without DP_STATE events a disturbance ends with the master's step: the slave that leaves later does so alone.
TEST(ImpliedExchange, OfAKindThatDoesNotTellItsStepsIsJudgedByTheMasters) {
  const tb::scenario::Scenario scenario = scenario_of({});
  bus::Segment segment;
  tb::Stations stations;
  stations.masters.push_back({&scenario.masters[0], std::make_unique<bus::Master1>(segment, bus::MasterConfig{}), {}});
  bus::SlaveParameters parameters;
  parameters.address = 5;
  parameters.cfg = {0x31};
  parameters.input_length = parameters.output_length = 2;
  stations.masters[0].master->add_slave(parameters);
  stations.masters[0].slaves[5] = "io";
  tb::ExchangeWatch watch(scenario, stations, false);
  const auto step = [&watch](tb::Tick now, bus::SlaveState state) {
    watch.master_state(now, "plc", "io", bus::name(state));
  };
  step(100, bus::SlaveState::kDataExchange);
  tb::scenario::Action glitch;
  glitch.what = tb::scenario::ActionKind::kGlitch;
  watch.acts(glitch, 200);
  step(300, bus::SlaveState::kDiagnose);
  step(400, bus::SlaveState::kDataExchange);
  tb::SlaveResult slave;
  EXPECT_THAT(watch.finish({slave}).at(0).seen, HasSubstr("since "));
  step(500, bus::SlaveState::kDiagnose);
  EXPECT_THAT(watch.finish({slave}).at(0).seen, HasSubstr("left 1 time without the script"));
}

/// A host at serve's port has a slave that no master of the scenario has.
class ExchangeWithAHost : public testing::Test {
 protected:
  ExchangeWithAHost() {
    does(profibus::Reason::kPrmAccepted);
    does(profibus::Reason::kCfgAccepted);
    state(profibus::DpState::kDataExch);
  }
  void does(profibus::Reason reason) {
    profibus::Event event{};
    event.reason = reason;
    event.at = ++now_;
    watch_.event(0, event);
  }
  void state(profibus::DpState to) {
    profibus::Event event{};
    event.reason = profibus::Reason::kDpState;
    event.at = ++now_;
    event.b = static_cast<std::uint16_t>(to);
    watch_.event(0, event);
    slave_.status.dp_state = to;
  }
  void expire() {
    does(profibus::Reason::kWatchdogExpired);
    state(profibus::DpState::kWaitPrm);
  }
  void sends() {
    bus::WireTelegram wire;
    wire.start = ++now_;
    wire.decoded = bus::decode(bus::encode(bus::make_telegram(5, 2, 0x49)));
    watch_.telegram({now_, wire});
  }
  tb::ExpectationResult judged() { return watch_.finish({slave_}).at(0); }

  const tb::scenario::Scenario scenario_ = tb::scenario::parse(
      "name: x\nbaud: 12M\nend: 8ms\nslaves:\n  - {name: io, address: 5, init: {ident: 0x0CC9, max_inputs: 2, "
      "max_outputs: 2, cfg: \"31\"}}\n",
      "x.yaml");
  tb::Stations stations_;
  tb::ExchangeWatch watch_{scenario_, stations_, true};
  tb::SlaveResult slave_;
  tb::Tick now_ = 0;
};

TEST_F(ExchangeWithAHost, IsExpectedOnceItHasParameterisedTheSlave) {
  EXPECT_TRUE(judged().passed);
  EXPECT_EQ(judged().line, 5);
  EXPECT_TRUE(tb::ExchangeWatch(scenario_, stations_, true).finish({slave_}).empty()) << "not addressed";
  EXPECT_TRUE(tb::ExchangeWatch(scenario_, stations_, false).finish({slave_}).empty()) << "no host";
}

TEST_F(ExchangeWithAHost, IsNotLeftByTheWatchdogWhileTheHostGoesOn) {
  expire();
  EXPECT_TRUE(judged().passed) << "the master may have been ended: " << judged().seen;
  sends();
  EXPECT_THAT(judged().seen, HasSubstr("left 1 time without the script, first at"));
  EXPECT_THAT(judged().seen, HasSubstr("WD_EXPIRED; WAIT_PRM at the end"));
  state(profibus::DpState::kDataExch);
  EXPECT_FALSE(judged().passed) << "it came back too late";
}

TEST_F(ExchangeWithAHost, EndsWithAHostThatHangsUpOrReleasesTheSlave) {
  watch_.host_gone();
  expire();
  sends();  // of the next host
  EXPECT_TRUE(judged().passed) << judged().seen;
  does(profibus::Reason::kPrmAccepted);
  EXPECT_FALSE(judged().passed) << "the next host has it";
  state(profibus::DpState::kDataExch);
  does(profibus::Reason::kPrmUnlock);
  state(profibus::DpState::kWaitPrm);
  EXPECT_TRUE(judged().passed) << judged().seen;
}

TEST_F(ExchangeWithAHost, IsNotReachedWithAnotherConfigurationEvenIfTheHostHangsUp) {
  does(profibus::Reason::kPrmAccepted);
  does(profibus::Reason::kCfgDiffers);
  state(profibus::DpState::kWaitPrm);
  watch_.host_gone();
  EXPECT_FALSE(judged().passed);
}

TEST(ImpliedExchange, OfASlaveThatIsListedByItsAddressIsExpectedToo) {
  const auto listed = [](const char* more) {
    tb::scenario::Scenario scenario = tb::scenario::parse(
        std::string("name: x\nbaud: 12M\nend: 8ms\nslaves:\n  - {name: io, address: 5, init: {ident: 0x0CC9, "
                    "max_inputs: 2, max_outputs: 2, cfg: \"31\"}}\n"
                    "masters:\n  - {name: plc, address: 2, slaves: [{address: 5, cfg: \"31\", ident: ") +
            more + "}, {address: 9, cfg: \"31\", ident: 1}]}\n",
        "x.yaml");
    tb::Bench bench(scenario, {}, tb::make_pin_execution());
    return bench.run([](tb::Tick) { return true; });
  };
  EXPECT_TRUE(implied(listed("0x0CC9")).passed);
  EXPECT_FALSE(implied(listed("1")).passed);
}

TEST(ImpliedExchange, IsNotSwitchedOffByAnExpectationThatAsksForMore) {
  for (const char* more :
       {"event: WD_EXPIRED, count_at_most: 0", "dp_state: wait_prm, by: 5ms", "data_exchanges_at_most: 5"})
    EXPECT_EQ(tb::verdict(run({std::string("expect:\n  - {slave: io, ") + more + "}\n", ", ident: 0xC90C"})),
              tb::Verdict::kFailed)
        << more;
}

TEST(ImpliedExchange, ComesBackWithTheMaster) {
  expect_passes({"script:\n  - {at: 4ms, do: stop_master}\n  - {at: 5ms, do: start_master}\n"});
}

TEST(ImpliedExchange, MustComeBackInTime) {
  expect_fails({"script:\n  - {at: 4ms, do: stop_master}\n  - {at: 7990us, do: start_master}\n"}, "at the end");
}

TEST(ImpliedExchange, OfOneSlaveMayEndWithAnotherOnlyByItsOwnFault) {
  // The user loses the DPRAM for good, without a script.
  expect_fails({"", "", "start_delay: 100ms"}, "never, OFFLINE at the end");
}

TEST(ImpliedExchange, ComesBackAfterAReset) {
  expect_passes({"script:\n  - {at: 4ms, do: reset_chip, slave: io, for: 20us}\n", "", "", "", "20ms"});
}

// --- checks

TEST(ChecksOfAScenario, FailByDefaultAndMayBeReportedAllowedOrOff) {
  const auto words = [](const std::string& mode, const std::string& more = "") {
    return tb::words(run({"checks: {" + mode + "INTR0_SERVICE: {max: 1ns}}\n" + more, "", "", ", prm_mode: 2"}));
  };
  EXPECT_EQ(words(""), "FAILED: 2 violations");
  EXPECT_EQ(words("mode: fail, "), "FAILED: 2 violations");
  EXPECT_EQ(words("mode: report, "), "PASSED, 2 violations not judged");
  EXPECT_EQ(words("mode: off, "), "PASSED, checks off");
  EXPECT_EQ(words("", "allow:\n  - {event: INTR0_SERVICE}\n"), "PASSED, 2 violations allowed");
}

TEST(ChecksOfAScenario, CannotBeExpectedWhenTheyAreNotMade) {
  const std::string expectation = "expect:\n  - {slave: io, event: TIMING_TS, count_at_most: 0}\n";
  const auto refused = [&](const std::string& checks) {
    try {
      run({checks + expectation});
      return std::string("not refused");
    } catch (const tb::InputError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_THAT(refused("checks: {mode: off}\n"), HasSubstr("x.yaml:10: TIMING_TS is a check, which is off"));
  EXPECT_THAT(refused("checks: {TIMING_TS: {enabled: false}}\n"),
              HasSubstr("x.yaml:10: TIMING_TS is a check, which is off"));
  EXPECT_EQ(refused("checks: {mode: report}\n"), "not refused");
}

}  // namespace
}  // namespace dsdpv1
