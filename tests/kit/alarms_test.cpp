// Alarms between a chip made with the kit and a class 1 master, by a scenario (docs/alarms.md): raised, read,
// acknowledged at SAP 51 or 50, and limited.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tb/bench/bench.hpp"
#include "tb/bench/verdict.hpp"
#include "tb/report/summary.hpp"
#include "tb/scenario/scenario.hpp"
#include "tests/kit/alarm_kind.hpp"

namespace dsdpv1::kit {
namespace {

const char* const kScenario = R"(
name: Alarms
baud: 12M
end: 15ms
chip: {kind: alarmer}
masters:
  - name: plc
    address: 1
    slaves: [{slave: mine, address: 8, ident: 0x0CC9, dpv1: true, alarms: {process: true, mode: 3, KEYS}}]
slaves:
  - {name: mine, address: 8, init: {ident: 0x0CC9, max_inputs: 2, max_outputs: 2, max_prm: 3, cfg: "31"}, user_cpu: {cycle: 1ms, raise: 31}}
expect:
  - {slave: mine, dp_state: data_exch, by: 8ms}
  - {slave: mine, event: ALARM}
)";

class AlarmsOfTheKit : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (tb::find_chip_kind("alarmer") == nullptr) tb::add_chip_kind(alarm_kind());
  }
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// The log, with `keys` of `alarms`.
  std::string run(tb::Engine engine, const std::string& keys) {
    std::string text = kScenario;
    text.replace(text.find("KEYS"), 4, keys);
    const std::string file = (folder_ / "x.yaml").string(), log = (folder_ / "x.log").string();
    std::ofstream(file) << text;
    const tb::scenario::Scenario scenario = tb::scenario::load(file, {});
    tb::RunOptions options;
    options.engine = engine;
    options.log = log;
    options.trace = (folder_ / "x.trace").string();
    tb::Bench bench(scenario, options, tb::make_pin_execution());
    const tb::RunResult result = bench.run([](tb::Tick) { return true; });
    EXPECT_EQ(tb::verdict(result), tb::Verdict::kPassed) << tb::summary(result);
    return content(log) + content(options.trace);
  }
  static std::string content(const std::string& path) {
    std::ifstream in(path);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }
  static int count(const std::string& text, const std::string& what) {
    int found = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
    return found;
  }

 private:
  std::filesystem::path folder_;
};

TEST_F(AlarmsOfTheKit, AreAcknowledgedAtEitherSapWithBothEnginesAlike) {
  for (const std::string extra : {"false", "true"}) {
    const std::string log = run(tb::Engine::kSkip, "extra_sap: " + extra);
    const int raised = count(log, "open until the master acknowledges it");
    EXPECT_GE(raised, 10);
    EXPECT_EQ(count(log, "is acknowledged"), raised);
    EXPECT_EQ(count(log, extra == "true" ? "MSAC1 alarm: Alarm_Ack slot" : "MSAC1: Alarm_Ack slot"), 2 * raised);
    EXPECT_EQ(count(log, " mine OPEN 01\n"), raised) << "one at a time";
    EXPECT_TRUE(run(tb::Engine::kStep, "extra_sap: " + extra) == log);
  }
}

TEST_F(AlarmsOfTheKit, AreRefusedBeyondTheChipsCapacityWhenNoneIsAcknowledged) {
  const std::string log = run(tb::Engine::kSkip, "acknowledge: false");
  EXPECT_EQ(count(log, "open until the master acknowledges it"), 8);
  EXPECT_GT(count(log, "refused: 8 are open, Alarm_Mode 3"), 0);
  EXPECT_EQ(count(log, "Alarm_Ack"), 0);
}

}  // namespace
}  // namespace dsdpv1::kit
