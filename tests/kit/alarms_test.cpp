// Alarms between a chip made with the kit and a class 1 master, by a scenario (docs/alarms.md): raised, read,
// acknowledged at SAP 51 or 50, and limited.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tb/bench/bench.hpp"
#include "tb/bench/verdict.hpp"
#include "tb/kit/slave_kit.hpp"
#include "tb/report/summary.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::kit {
namespace {

using profibus::kNever;

enum : PinNumber { kStart = kOwn, kRaise, kOpen };

/// A rise of START initialises the slave; a number at RAISE is the slot of a process alarm; OPEN counts those that are
/// open. It takes an Alarm_Ack one edge after the slave has it.
class AlarmPort : public UserPort {
 public:
  explicit AlarmPort(Chip& chip) : chip_(chip) {}

  void reset() override { starts_at_ = raises_at_ = takes_at_ = kNever; }
  void input(Tick at, PinNumber pin, Level level) override {
    if (pin == kStart && level == 1) starts_at_ = profibus::first_edge_after(at);
    if (pin == kRaise && level > 0) raises_at_ = profibus::first_edge_after(at);
  }
  void eval(Cycle now) override {
    if (now == starts_at_) start(now);
    if (now == raises_at_) raise(now);
    if (now == takes_at_) alarms().mail().due.clear();
  }
  void show(Cycle now) override {
    for (Cycle* at : {&starts_at_, &raises_at_, &takes_at_})
      if (*at == now) *at = kNever;
    if (alarms().with_user() && takes_at_ == kNever) takes_at_ = now + 1;
    chip_.drive_at(now, kOpen, static_cast<Level>(alarms().open()));
  }
  Cycle next() const override { return std::min({starts_at_, raises_at_, takes_at_}); }

 private:
  profibus::Alarms& alarms() { return chip_.user().msac().alarms; }
  void start(Cycle now) {
    profibus::SlaveConfig config;
    config.address = 5;
    config.ident = 0x0B0E;
    config.dpv1 = true;
    config.max_input = config.max_output = 1;
    config.max_diag = 20;
    config.max_prm = 3;
    config.max_cfg = 2;
    chip_.user().initialise(now, config);
  }
  void raise(Cycle now) {
    const auto slot = static_cast<std::uint8_t>(chip_.level(kRaise));
    const std::uint8_t block[] = {4, 2, slot, static_cast<std::uint8_t>(slot << 3U | 1)};
    chip_.user().new_alarm(now, block, 4);
  }

  Chip& chip_;
  Cycle starts_at_ = kNever, raises_at_ = kNever, takes_at_ = kNever;
};

void program(Cpu& cpu) {
  cpu.wait(10 * bus::kTicksPerUs);
  cpu.set(kStart, 1);
  for (Level slot = 1; slot < 32; ++slot) {
    cpu.wait(cpu.period());
    cpu.set(kRaise, slot);
    cpu.wait(bus::kTicksPerUs);
    cpu.set(kRaise, 0);
  }
}

Parts parts() {
  Parts parts{"alarmer", "slave with alarms"};
  parts.pins = {{"START", kInput, 0}, {"RAISE", kInput, 0, 5}, {"OPEN", kOutput, 0, 6}};
  parts.capacities = {3, 2, 1, 0, 8};
  parts.port = [](Chip& chip) { return std::make_unique<AlarmPort>(chip); };
  parts.program = program;
  return parts;
}

const char* const kScenario = R"(
name: Alarms
baud: 12M
end: 15ms
chip: {kind: alarmer}
masters:
  - name: plc
    address: 1
    slaves: [{slave: mine, address: 5, ident: 0x0B0E, dpv1: true, alarms: {process: true, mode: 3, KEYS}}]
slaves:
  - {name: mine, address: 5, init: {ident: 0x0B0E, max_inputs: 1, max_outputs: 1, max_prm: 3, cfg: 10 20}, user_cpu: {cycle: 1ms}}
expect:
  - {slave: mine, dp_state: data_exch, by: 8ms}
  - {slave: mine, event: ALARM}
)";

class AlarmsOfTheKit : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    static const Kind kind(parts());
    if (tb::find_chip_kind("alarmer") == nullptr) tb::add_chip_kind(kind);
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
