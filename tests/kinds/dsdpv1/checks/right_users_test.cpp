// No false alarm: scenarios with right users, made from a seed, break none of the rules on what the user owes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "kinds/dsdpv1/checks/check.hpp"
#include "tb/bench/bench.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1 {
namespace {

/// The text of a scenario. A user takes at most 3 ms a turn and 10 ms in a pause, so that a watchdog of 25 ms is long
/// enough.
class RightUser {
 public:
  explicit RightUser(unsigned seed) : random_(seed) {}

  std::string scenario() {
    std::string text = "name: right user\nend: 120ms\nbaud: " + pick({"12M", "6M", "3M", "1.5M", "500k"});
    text += "\nchip: {search_window_ms: 2, " + port() + "}\nslaves:\n  - name: demo\n    address: 5\n" + init();
    text += "    user_cpu: {" + user() + "}\nmasters:\n  - name: plc\n    address: 2\n    start: 1ms\n    slaves:\n";
    text += "      - {slave: demo, outputs: \"01 02\", sync: true, freeze: true, " + master() + "}\nscript:\n";
    for (int at = 40; at < 110; at += below(12) + 1) text += fmt::format("  - {{at: {}ms, do: {}}}\n", at, action(at));
    return text;
  }

 private:
  int below(int limit) { return static_cast<int>(random_() % static_cast<unsigned>(limit)); }
  std::string pick(const std::vector<std::string>& words) {
    return words[static_cast<std::size_t>(below(static_cast<int>(words.size())))];
  }
  std::string port() {
    serial_ = below(3) == 0;
    const std::string mode = pick({"spi", "uart"});
    return serial_ ? "kind: dsdpv1_rsu, mode: " + mode : "kind: dsdpv1";
  }
  std::string init() {
    const bool equal = below(2) == 0;
    return fmt::format(
        "    init: {{ident: 1, max_inputs: 4, max_outputs: 4, max_prm: 3, cfg: \"{}\", sync: true, freeze: true, dpv1: "
        "true, prm_mode: {}, cfg_mode: {}}}\n",
        pick({"31", "11 21", "13 23", "10", "20"}), equal ? 1 : 2 * below(2), below(3));
  }
  std::string user() {
    const std::string behaviour = pick({"behaviour: loop_back", "behaviour: count", "behaviour: constant"});
    const int cycle = serial_ ? 1000 + below(2000) : 20 + below(3000);
    return fmt::format(
        "{}, cycle: {}us, judge_delay: {}us, judge_in_handler: {}, dpv1: {{objects: [{{slot: 1, index: 1, data: \"01 "
        "02 03 04\"}}]}}",
        behaviour, cycle, below(3000), below(2) == 0 ? "true" : "false");
  }
  std::string master() {
    return fmt::format("user_prm: \"00 00 00\", dpv1: {}, watchdog: {}", pick({"true", "false"}),
                       pick({"0ns", "25ms", "50ms", "200ms"}));
  }
  static std::string reset() { return "reset_chip, slave: demo, for: 10us"; }
  /// An initialisation comes 100 ms after the one before (U9).
  std::string action(int at) {
    if (at > 101 && !std::exchange(again_, true)) return "reinitialise, slave: demo";
    const std::string chosen =
        pick({fmt::format("set_outputs, slave: demo, bytes: \"{:02X} {:02X}\"", below(256), below(256)),
              fmt::format("pause_user, slave: demo, for: {}ms", below(10) + 1), "clear", "operate",
              "global_control, sync: true", "global_control, unsync: true", "global_control, freeze: true",
              "global_control, unfreeze: true", reset(), "stop_master", "start_master", "unplug, slave: demo",
              "plug, slave: demo", "set_diagnosis, slave: demo, type: external, bytes: \"01\"",
              "c1_read, slave: demo, slot: 1, index: 1, length: 4"});
    again_ = again_ || chosen == reset();
    return chosen;
  }

  std::mt19937 random_;
  bool serial_ = false;
  bool again_ = false;  ///< initialised again, or will be after a reset
};

/// The others depend on the scenario's rates: HOLD_INTERVAL.
bool is_duty(checks::CheckId check) {
  if (check == checks::Check::kLookInWindow) return true;
  return check.index >= checks::CheckId(checks::kFirstCommonCheck).index &&
         check.index < checks::CheckId(checks::kFirstSpiCheck).index;
}

using Counts = std::map<std::string, std::uint64_t>;

/// Adds how often each rule was evaluated.
void expect_no_alarm(unsigned seed, Counts& evaluated) {
  const std::string text = RightUser(seed).scenario();
  tb::scenario::Scenario scenario = tb::scenario::parse(text, "right.yaml");
  scenario.expects_exchange = false;
  tb::RunOptions options;
  options.checks = tb::ChecksMode::kReport;
  tb::Bench bench(scenario, options, tb::make_pin_execution());
  const tb::RunResult result = bench.run([](tb::Tick) { return true; });
  for (const tb::CheckResult& each : result.checks) {
    evaluated[each.rule->id] += each.record.count;
    for (const checks::Violation& violation : each.listed)
      if (is_duty(violation.check))
        ADD_FAILURE() << "seed " << seed << ": " << each.rule->id << ' ' << violation.text << '\n' << text;
  }
}

void expect_no_alarms(unsigned from, unsigned to) {
  Counts evaluated;
  for (unsigned seed = from; seed < to && !testing::Test::HasFailure(); ++seed) expect_no_alarm(seed, evaluated);
  for (const checks::Check check : checks::kAllChecks)
    if (is_duty(check)) EXPECT_GE(evaluated[checks::rule(check).id], (to - from) / 12) << checks::rule(check).id;
}

TEST(RightUsers, CauseNoFalseAlarmInSixtyScenarios) { expect_no_alarms(0, 60); }
TEST(RightUsers, CauseNoFalseAlarmInAThousandScenarios) { expect_no_alarms(1000, 2000); }

}  // namespace
}  // namespace dsdpv1
