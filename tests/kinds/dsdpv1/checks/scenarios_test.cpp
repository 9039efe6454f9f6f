// Each check that a user CPU can violate, with a scenario made for it: with --checks fail the run fails; if the
// scenario allows it, the run passes; and there are no other findings. Firmware on the ARM board (firmware/rude.c)
// violates the checks that the driver on the native user CPU cannot. Checks that only the chip, or directly moved pins,
// can violate are in values_test.cpp and cells_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "kinds/dsdpv1/checks/check.hpp"
#include "tb/bench/bench.hpp"
#include "tb/bench/verdict.hpp"
#include "tb/scenario/scenario.hpp"
#ifdef RUDE_FOLDER
#include "kinds/dsdpv1/board/arm_user.hpp"
#endif

namespace dsdpv1 {
namespace {

tb::RunResult run_on_pins(const tb::scenario::Scenario& scenario, tb::ChecksMode mode = tb::ChecksMode::kReport) {
  tb::RunOptions options;
  options.checks = mode;
  auto execution = tb::make_pin_execution();
  execution->timeline().check_announcements();
  tb::Bench bench(scenario, options, std::move(execution));
  return bench.run([](tb::Tick) { return true; });
}

struct Case {
  const char* name;
  std::vector<const char*> found;   ///< ids, the one that it is about first
  const char* user_cpu;             ///< beside cycle
  const char* script;               ///< actions
  const char* limits;               ///< of checks
  std::vector<const char*> events;  ///< allowed violations that the core itself reports
};

void PrintTo(const Case& each, std::ostream* out) { *out << each.name; }

const char* const kNone = "";

#ifdef RUDE_FOLDER
#define RUDE(name) "kind: arm\n      without_mailbox: leave_out\n      elf: " RUDE_FOLDER "/" name ".elf"
#endif

const Case kCases[] = {
    {"BothOwn",
     {"OWNERSHIP_BOTH_OWN", "OWNERSHIP_SYNC_WINDOW"},
     kNone,
     "{at: 5ms, do: early_r_sta, slave: demo, times: 200}",
     kNone,
     {"HANDSHAKE_BOTH_OWN"}},
    {"SyncWindow", {"OWNERSHIP_SYNC_WINDOW"}, kNone, kNone, "OWNERSHIP_SYNC_WINDOW: {min: 200ns}", {}},
    {"LookInWindow", {"LOOK_IN_WINDOW"}, kNone, kNone, "LOOK_IN_WINDOW: {min: 200ns}", {}},
    {"NoLook",
     {"LOOK_IN_WINDOW", "OWNERSHIP_BOTH_OWN"},
     kNone,
     "{at: 5ms, do: early_r_sta, slave: demo, times: 200}",
     "OWNERSHIP_SYNC_WINDOW: {enabled: false}",
     {"HANDSHAKE_BOTH_OWN"}},
    {"NeverReleased",
     {"OWNERSHIP_NEVER_RELEASED", "HOLD_INTERVAL"},
     kNone,
     "{at: 6ms, do: hold_dpram, slave: demo, for: 11ms}",
     kNone,
     {}},
    {"Ts",
     {"TIMING_TS", "TIMING_TD"},
     "access: {wr_low: 12ns, data_setup: 12ns}",
     kNone,
     kNone,
     {"HOST_TS", "HOST_TD_SETUP", "HOST_READ_UNKNOWN", "HOST_SETS_BIT"}},
    {"Td",
     {"TIMING_TD"},
     "access: {data_setup: 12ns}",
     kNone,
     kNone,
     {"HOST_TD_SETUP", "HOST_READ_UNKNOWN", "HOST_SETS_BIT"}},
    {"AddressHold",
     {"TIMING_ADDRESS_HOLD"},
     "access: {address_hold: 12ns}",
     kNone,
     kNone,
     {"HOST_TD_HOLD", "HOST_READ_UNKNOWN", "HOST_SETS_BIT"}},
    {"DataHold",
     {"TIMING_DATA_HOLD"},
     "access: {data_hold: 12ns}",
     kNone,
     kNone,
     {"HOST_TD_HOLD", "HOST_READ_UNKNOWN", "HOST_SETS_BIT"}},
    // Started so that no edge of CLK samples A before it has changed: then B006 would be misread, too.
    {"Tc",
     {"TIMING_TC"},
     "start_delay: 20.333ns\n      access: {address_setup: -0.05ns, cs_lead: 0ns}",
     kNone,
     kNone,
     {"HOST_TC"}},
    {"Tw", {"TIMING_TW", "COUNT_BY_USER"}, "access: {rd_low: 31ns, rd_sample: 40ns}", kNone, kNone, {"HOST_TW"}},
    {"ReadBack", {"TIMING_READ_BACK"}, kNone, kNone, "TIMING_READ_BACK: {min: 2us}", {}},
    {"Intr0Service",
     {"INTR0_SERVICE"},
     "judge_in_handler: false",
     "{at: 1100us, do: pause_user, slave: demo, for: 3ms}",
     "INTR0_SERVICE: {max: 1ms}",
     {}},
    {"HoldInterval", {"HOLD_INTERVAL"}, kNone, "{at: 10ms, do: hold_dpram, slave: demo, for: 2ms}", kNone, {}},
    {"CountByUser", {"COUNT_BY_USER", "TIMING_TW"}, "access: {rd_sample: 31ns}", kNone, kNone, {"HOST_TW"}},
    {"Csr", {"TIMING_CSR"}, kNone, kNone, "TIMING_CSR: {min: 20ns}", {}},
#ifdef RUDE
    {"NoRequest", {"OWNERSHIP_NO_REQUEST"}, RUDE("no_request"), kNone, kNone, {}},
    {"NotOwner", {"OWNERSHIP_NOT_OWNER"}, RUDE("not_owner"), kNone, kNone, {"HOST_NOT_OWNER"}},
    {"CellOfChip", {"CELL_OF_CHIP"}, RUDE("cell_of_chip"), kNone, kNone, {"HOST_READ_ONLY"}},
    {"SetsStatusBit", {"CELL_OF_CHIP"}, RUDE("sets_status_bit"), kNone, kNone, {"HOST_SETS_BIT"}},
    {"FlagByUser", {"FLAG_BY_USER"}, RUDE("flag_by_user"), kNone, kNone, {"HOST_SETS_BIT"}},
    {"CrcFetched", {"CRC_FETCHED"}, RUDE("crc_fetched"), kNone, kNone, {}},
    {"VerdictUnfetched", {"VERDICT_UNFETCHED"}, RUDE("verdict_unfetched"), kNone, kNone, {}},
    {"BlockWhole", {"BLOCK_WHOLE"}, RUDE("block_whole"), kNone, kNone, {}},
    {"UserRefused", {"USER_REFUSED"}, RUDE("user_refused"), kNone, kNone, {}},
    {"ReadyUnseen", {"READY_UNSEEN"}, RUDE("ready_unseen"), kNone, kNone, {}},
#endif
    {"BlockServed",
     {"BLOCK_SERVED"},
     "judge_in_handler: false",
     "{at: 1100us, do: pause_user, slave: demo, for: 3ms}",
     "BLOCK_SERVED: {max: 1ms}",
     {}},
    {"VerdictGiven", {"VERDICT_GIVEN"}, "judge_prm: never", kNone, "VERDICT_GIVEN: {max: 1ms}", {}},
    {"OutputsFetched",
     {"OUTPUTS_FETCHED"},
     kNone,
     "{at: 10ms, do: pause_user, slave: demo, for: 3ms}",
     "OUTPUTS_FETCHED: {max: 2ms}",
     {}},
    {"OutputsOverwritten",
     {"OUTPUTS_OVERWRITTEN"},
     kNone,
     "{at: 10ms, do: pause_user, slave: demo, for: 3ms}",
     "OUTPUTS_OVERWRITTEN: {max: 3}",
     {}},
    {"InputsRenewed",
     {"INPUTS_RENEWED"},
     kNone,
     "{at: 10ms, do: pause_user, slave: demo, for: 3ms}",
     "INPUTS_RENEWED: {max: 2ms}",
     {}},
    {"CrcWritten", {"CRC_WRITTEN"}, kNone, "{at: 10ms, do: wrong_crc, slave: demo, area: inputs}", kNone, {}},
};

std::string text_of(const Case& each, bool allowed) {
  std::string text =
      "name: check\nbaud: 12M\nend: 20ms\nslaves:\n  - name: demo\n    address: 5\n"
      "    init: {ident: 1, max_inputs: 2, max_outputs: 2, cfg: \"31\", prm_mode: 2, cfg_mode: 2}\n    user_cpu:\n     "
      " cycle: 200us\n";
  if (*each.user_cpu != '\0') text += std::string("      ") + each.user_cpu + "\n";
  text += "masters: [{name: plc, address: 2, start: 1ms, slaves: [{slave: demo, outputs: \"01 02\"}]}]\n";
  if (*each.script != '\0') text += std::string("script:\n  - ") + each.script + "\n";
  if (*each.limits != '\0') text += std::string("checks:\n  ") + each.limits + "\n";
  std::vector<const char*> codes = each.events;
  if (allowed) codes.insert(codes.end(), each.found.begin(), each.found.end());
  if (!codes.empty()) text += "allow:\n";
  for (const char* code : codes) text += std::string("  - {event: ") + code + ", slave: demo}\n";
  return text;
}

tb::RunResult run(const Case& each, bool allowed, tb::ChecksMode mode) {
#ifdef RUDE_FOLDER
  tb::add_arm_board();
#endif
  tb::scenario::Scenario scenario = tb::scenario::parse(text_of(each, allowed), "check.yaml");
  scenario.expects_exchange = false;  // some users break too much for that
  return run_on_pins(scenario, mode);
}

std::set<std::string> broken(const tb::RunResult& result) {
  std::set<std::string> ids;
  for (const tb::CheckResult& check : result.checks)
    if (check.record.violations != 0) ids.insert(check.rule->id);
  return ids;
}

class EachCheck : public testing::TestWithParam<Case> {};

TEST_P(EachCheck, IsFoundByItsScenarioAndFailsTheRun) {
  const tb::RunResult result = run(GetParam(), false, tb::ChecksMode::kFail);
  EXPECT_EQ(broken(result), std::set<std::string>(GetParam().found.begin(), GetParam().found.end()));
  EXPECT_EQ(tb::verdict(result), tb::Verdict::kFailed);
  std::uint64_t counted = 0;
  for (const tb::CheckResult& check : result.checks) {
    counted += check.record.violations;
    EXPECT_EQ(check.listed.size(), std::min<std::uint64_t>(check.record.violations, tb::CheckResult::kListed));
  }
  EXPECT_EQ(result.violations, counted);
}

TEST_P(EachCheck, DoesNotFailTheRunWhenAllowedReportedOrOff) {
  const tb::RunResult allowed = run(GetParam(), true, tb::ChecksMode::kFail);
  EXPECT_NE(tb::verdict(allowed), tb::Verdict::kFailed);
  EXPECT_FALSE(broken(allowed).empty());
  const tb::RunResult reported = run(GetParam(), false, tb::ChecksMode::kReport);
  EXPECT_NE(tb::verdict(reported), tb::Verdict::kFailed);
  EXPECT_FALSE(broken(reported).empty());
  const tb::RunResult off = run(GetParam(), false, tb::ChecksMode::kOff);
  EXPECT_NE(tb::verdict(off), tb::Verdict::kFailed);
  EXPECT_TRUE(off.checks.empty());
}

INSTANTIATE_TEST_SUITE_P(Checks, EachCheck, testing::ValuesIn(kCases),
                         [](const auto& each) { return each.param.name; });

std::uint64_t events(const tb::RunResult& result, const char* code) {
  return static_cast<std::uint64_t>(std::count_if(
      result.occurrences.begin(), result.occurrences.end(),
      [code](const tb::Occurrence& each) { return each.code == code; }));
}

std::uint64_t violations(const tb::RunResult& result, checks::Check check) {
  for (const tb::CheckResult& each : result.checks)
    if (std::string(each.rule->id) == checks::rule(check).id) return each.record.violations;
  return 0;
}

TEST(ChecksAndCore, FindTheSameViolationsIndependently) {
  const struct {
    const char* name;
    checks::Check check;
    const char* event;
  } pairs[] = {{"BothOwn", checks::Check::kBothOwn, "HANDSHAKE_BOTH_OWN"},
               {"Ts", checks::Check::kTs, "HOST_TS"},
               {"Td", checks::Check::kTd, "HOST_TD_SETUP"},
               {"DataHold", checks::Check::kDataHold, "HOST_TD_HOLD"},
               {"Tc", checks::Check::kTc, "HOST_TC"},
               {"Tw", checks::Check::kTw, "HOST_TW"},
               {"CountByUser", checks::Check::kTw, "HOST_TW"}};
  for (const auto& pair : pairs) {
    const Case* found = std::find_if(std::begin(kCases), std::end(kCases),
                                     [&pair](const Case& each) { return std::string(each.name) == pair.name; });
    ASSERT_NE(found, std::end(kCases));
    const tb::RunResult result = run(*found, false, tb::ChecksMode::kReport);
    EXPECT_GT(violations(result, pair.check), 0U) << pair.name;
    EXPECT_EQ(violations(result, pair.check), events(result, pair.event)) << pair.name;
  }
}

tb::RunResult run_spi(const char* end, const char* spi, const char* rest) {
  const tb::scenario::Scenario scenario = tb::scenario::parse(
      std::string("name: spi\nbaud: 12M\nend: ") + end +
          "\nchip: {kind: dsdpv1_rsu, mode: spi}\nslaves:\n  - name: demo\n    address: 5\n"
          "    init: {ident: 1, max_inputs: 2, max_outputs: 2, cfg: \"31\"}\n    user_cpu: {cycle: 200us, spi: {" +
          spi + "}}\n" + rest,
      "spi.yaml");
  return run_on_pins(scenario);
}

TEST(ChecksAndCore, FindTheSameFramesThatFollowAWriteTooSoon) {
  const tb::RunResult result = run_spi("150us", "clock: 24000, lag: 50ns, gap: 100ns", "");
  EXPECT_GT(violations(result, checks::Check::kWriteGap), 0U);
  EXPECT_EQ(violations(result, checks::Check::kWriteGap), events(result, "SPI_WRITE_GAP"));
}

TEST(HoldOverSpi, IsFoundAgainstItsLimitAndAgainstTheIntervalOfTheBus) {
  const char* const bus =
      "masters: [{name: plc, address: 2, start: 1ms, slaves: [{slave: demo, outputs: \"01 02\"}]}]\n"
      "checks: {B014_HELD: {max: 1ms}}\n";
  const tb::RunResult quiet = run_spi("20ms", "clock: 9000", bus);
  EXPECT_EQ(violations(quiet, checks::Check::kOwned), 0U);
  const tb::RunResult held =
      run_spi("20ms", "clock: 9000",
              (std::string(bus) + "script: [{at: 10ms, do: hold_dpram, slave: demo, for: 2ms}]\n").c_str());
  EXPECT_EQ(violations(held, checks::Check::kOwned), 1U);
  EXPECT_GT(violations(held, checks::Check::kOwnerInterval), violations(quiet, checks::Check::kOwnerInterval));
}

TEST(ChecksAndCore, FindTheSameViolationsOverSpi) {
  const tb::scenario::Scenario scenario = tb::scenario::parse(
      "name: fast\nbaud: 12M\nend: 150us\nchip: {kind: dsdpv1_rsu, mode: spi}\nslaves:\n  - name: demo\n    address: "
      "5\n"
      "    init: {ident: 1, max_inputs: 2, max_outputs: 2, cfg: \"31\"}\n"
      "    user_cpu: {cycle: 50us, spi: {clock: 10500, lead: 49ns, lag: 48ns}}\n",
      "fast.yaml");
  const tb::RunResult result = run_on_pins(scenario);
  const std::pair<checks::Check, const char*> pairs[] = {{checks::Check::kSckHigh, "SPI_SCK_HIGH"},
                                                         {checks::Check::kSckLow, "SPI_SCK_LOW"},
                                                         {checks::Check::kXssLead, "SPI_XSS_LEAD"},
                                                         {checks::Check::kXssLag, "SPI_XSS_LAG"}};
  for (const auto& [check, event] : pairs) {
    EXPECT_GT(violations(result, check), 0U) << event;
    EXPECT_EQ(violations(result, check), events(result, event)) << event;
  }
  EXPECT_EQ(result.checks.size(), 24U) << "those of SPI and of any port, no other";
}

tb::RunResult run_uart(const std::string& uart, const std::string& script) {
  const tb::scenario::Scenario scenario = tb::scenario::parse(
      "name: uart\nbaud: 12M\nend: 20ms\nchip: {kind: dsdpv1_rsu, mode: uart}\nslaves:\n  - name: demo\n    address: "
      "5\n"
      "    init: {ident: 1, max_inputs: 2, max_outputs: 2, cfg: \"31\"}\n    user_cpu: {cycle: 1ms, uart: {" +
          uart + "}}\nmasters: [{name: plc, address: 2, start: 1ms, slaves: [{slave: demo, outputs: \"01 02\"}]}]\n" +
          script,
      "uart.yaml");
  return run_on_pins(scenario);
}

const tb::CheckResult& found(const tb::RunResult& result, checks::Check check) {
  return *std::find_if(
      result.checks.begin(), result.checks.end(),
      [check](const tb::CheckResult& each) { return std::string(each.rule->id) == checks::rule(check).id; });
}

/// The telegrams are read as accesses to cells.
void expect_duties(const tb::RunResult& quiet, const tb::RunResult& paused) {
  for (const auto check : {checks::Check::kBlockServed, checks::Check::kOutputsFetched, checks::Check::kInputsRenewed})
    EXPECT_GE(found(quiet, check).record.count, 2U) << checks::rule(check).id;
  for (const auto check : {checks::Check::kOutputsFetched, checks::Check::kInputsRenewed}) {
    EXPECT_EQ(found(quiet, check).record.violations, 0U) << checks::rule(check).id;
    EXPECT_EQ(found(paused, check).record.violations, 1U) << checks::rule(check).id;
  }
}

const char* const kPause =
    "script: [{at: 10ms, do: pause_user, slave: demo, for: 5ms}]\n"
    "checks: {OUTPUTS_FETCHED: {max: 4ms}, INPUTS_RENEWED: {max: 4ms}}\n";

TEST(SerialDuties, OverSpi) {
  const std::string plc =
      "masters: [{name: plc, address: 2, start: 1ms, slaves: [{slave: demo, outputs: \"01 02\"}]}]\n";
  const tb::RunResult quiet = run_spi("20ms", "clock: 9000", plc.c_str());
  expect_duties(quiet, run_spi("20ms", "clock: 9000", (plc + kPause).c_str()));
  EXPECT_GE(found(quiet, checks::Check::kBlockWhole).record.count, 2U);
}

TEST(SerialDuties, OverTheUart) { expect_duties(run_uart("", ""), run_uart("", kPause)); }

/// A mistake of the host's, found at the pins and by the chip.
struct UartCase {
  const char* name;
  const char* order;
  const char* event;
  /// When the chip sees a fault at `at` of the pins: two cycles later, and an edge of RXD a cycle after its own.
  tb::Tick (*seen)(tb::Tick at);
  checks::Check check;
  bool spoilt;  ///< the telegram, or its rest, is followed by a silence
};

tb::Tick sampled_two_cycles_later(tb::Tick at) { return at + 500; }
tb::Tick edge_seen(tb::Tick at) { return (at / 250 + 3) * 250; }

const UartCase kUartCases[] = {
    {"Parity", "wrong_parity, slave: demo", "UART_PARITY", sampled_two_cycles_later, checks::Check::kRxdParity, true},
    {"Break", "send_break, slave: demo", "UART_FRAMING", sampled_two_cycles_later, checks::Check::kRxdBreak, true},
    {"Pause", "pause_telegram, slave: demo, for: 100us", "TELEGRAM_CUT", sampled_two_cycles_later,
     checks::Check::kRxdCharacterGap, true},
    {"TalkOver", "talk_over_reply, slave: demo", "UART_HALF_DUPLEX", edge_seen, checks::Check::kRxdHalfDuplex, false},
};

void PrintTo(const UartCase& each, std::ostream* out) { *out << each.name; }

class UartMistake : public testing::TestWithParam<UartCase> {};

TEST_P(UartMistake, IsFoundWhereTheChipMeetsItAndTheNextTelegramIsAnswered) {
  const UartCase& each = GetParam();
  const tb::RunResult quiet = run_uart("", "");
  const tb::RunResult result = run_uart("", std::string("script: [{at: 15ms, do: ") + each.order + "}]\n");
  EXPECT_TRUE(broken(quiet).empty());
  EXPECT_EQ(broken(result), std::set<std::string>{checks::rule(each.check).id});
  const tb::CheckResult& check = found(result, each.check);
  ASSERT_EQ(check.listed.size(), 1U);
  const auto event = std::find_if(result.occurrences.begin(), result.occurrences.end(),
                                  [&each](const tb::Occurrence& one) { return one.code == each.event; });
  ASSERT_NE(event, result.occurrences.end());
  EXPECT_EQ(event->at, each.seen(check.listed[0].at)) << check.listed[0].text;
  EXPECT_GT(check.listed[0].at, 15 * bus::kTicksPerMs);
  EXPECT_EQ(events(result, each.event), 1U);
  // The telegram is sent again, and after it as many as without the mistake.
  const auto replies = [](const tb::RunResult& of) { return found(of, checks::Check::kTxdReplyTime).record.count; };
  EXPECT_EQ(replies(result), replies(quiet));
  EXPECT_EQ(found(result, checks::Check::kRxdSilence).record.count, each.spoilt ? 1U : 0U);
  EXPECT_EQ(result.slaves.at(0).user.program->exchanges, quiet.slaves.at(0).user.program->exchanges);
  for (const tb::Occurrence& one : result.occurrences) EXPECT_NE(one.code.rfind("DSDPV1_ERR", 0), 0U) << one.text;
}

INSTANTIATE_TEST_SUITE_P(Checks, UartMistake, testing::ValuesIn(kUartCases),
                         [](const auto& each) { return each.param.name; });

TEST(ChecksAndCore, FindTheSameOverTheUartWhoseRateIsWrong) {
  for (const char* uart : {"rate: 1700000", "rate: 1750000", "gap: 30us"}) {
    const tb::RunResult result = run_uart(uart, "");
    EXPECT_EQ(violations(result, checks::Check::kRxdFraming) + violations(result, checks::Check::kRxdBreak),
              events(result, "UART_FRAMING"))
        << uart;
    EXPECT_EQ(violations(result, checks::Check::kRxdParity), events(result, "UART_PARITY")) << uart;
    EXPECT_EQ(violations(result, checks::Check::kRxdCharacterGap), events(result, "TELEGRAM_CUT")) << uart;
    EXPECT_FALSE(broken(result).empty()) << uart;
    EXPECT_EQ(result.checks.size(), 19U) << "those of the UART and of any port, no other";
  }
}

tb::RunResult run_lossy(const char* user_cpu, const char* script) {
  const std::string text =
      std::string("name: lost\nbaud: 12M\nend: 20ms\nslaves:\n  - name: demo\n    address: 5\n") +
      "    init: {ident: 1, max_inputs: 2, max_outputs: 2, cfg: \"31\"}\n    user_cpu: {" + user_cpu +
      "}\nmasters: [{name: plc, address: 2, start: 1ms, slaves: [{slave: demo, outputs: \"01 02\"}]}]\n" + script;
  const tb::scenario::Scenario scenario = tb::scenario::parse(text, "lost.yaml");
  return run_on_pins(scenario);
}

TEST(HoldInterval, FindsOneHoldForEachOutputThatWasLostByIt) {
  const tb::RunResult result = run_lossy("cycle: 20us",
                                         "script: [{at: 10ms, do: hold_dpram, slave: demo, for: 3ms},"
                                         " {at: 15ms, do: hold_dpram, slave: demo, for: 2ms}]\n");
  EXPECT_GT(violations(result, checks::Check::kHoldInterval), 10U);
  EXPECT_EQ(violations(result, checks::Check::kHoldInterval), result.slaves.at(0).status.outputs_missed);
}

TEST(OutputsOverwritten, AreThoseThatASlowUserMissedThoughHisHoldsAreShort) {
  const tb::RunResult result = run_lossy("cycle: 3ms", "");
  const tb::SlaveResult& slave = result.slaves.at(0);
  EXPECT_EQ(violations(result, checks::Check::kHoldInterval), 0U);
  EXPECT_GT(slave.status.outputs_missed, slave.user.program->outputs_received);
  const std::uint64_t seen = slave.status.outputs_missed + slave.user.program->outputs_received;
  EXPECT_LE(seen, slave.status.data_exchanges);
  EXPECT_GE(seen + 1, slave.status.data_exchanges) << "one may still wait";
}

#ifdef RUDE
TEST(Checks, TheSameFirmwareWithoutItsMistakesIsSilent) {
  const tb::RunResult result = run({"Polite", {}, RUDE("polite"), kNone, kNone, {}}, false, tb::ChecksMode::kFail);
  EXPECT_TRUE(broken(result).empty());
  EXPECT_NE(tb::verdict(result), tb::Verdict::kFailed);
}
#endif

TEST(Checks, OneSwitchedOffInTheScenarioIsNotInTheResult) {
  const Case each = {"Off",
                     {},
                     "access: {data_hold: 12ns}",
                     kNone,
                     "TIMING_DATA_HOLD: {enabled: false}",
                     {"HOST_TD_HOLD", "HOST_READ_UNKNOWN", "HOST_SETS_BIT"}};
  const tb::RunResult result = run(each, false, tb::ChecksMode::kFail);
  EXPECT_TRUE(broken(result).empty());
  EXPECT_NE(tb::verdict(result), tb::Verdict::kFailed);
  EXPECT_EQ(result.checks.size(), checks::rules().size() - 1);
}

}  // namespace
}  // namespace dsdpv1
