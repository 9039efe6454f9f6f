// The mailbox on the bench; a scenario brings it to data exchange. tb/bench, tb/scenario, bus/ and model/profibus/ do
// not know it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "io/input/input_error.hpp"
#include "tb/bench/bench.hpp"
#include "tb/bench/verdict.hpp"
#include "tb/report/result_fields.hpp"
#include "tb/report/summary.hpp"
#include "tests/mailbox/kind.hpp"

namespace dsdpv1 {
namespace {

using testing::HasSubstr;

const char* const kScenario = MAILBOX_FOLDER "/mailbox.yaml";

class MailboxOnTheBench : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (tb::find_chip_kind("mailbox") == nullptr) tb::add_chip_kind(mailbox::kind());
  }
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string read(const std::string& name) const {
    std::ifstream in(path(name));
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }
  tb::RunResult run(tb::Engine engine, const std::string& name, const std::vector<std::string>& set = {}) const {
    const tb::scenario::Scenario scenario = tb::scenario::load(kScenario, tb::scenario::parse_settings(set));
    tb::RunOptions options;
    options.engine = engine;
    options.checks = tb::ChecksMode::kReport;
    options.wave.path = path(name + ".vcd");
    options.log = path(name + ".log");
    options.trace = path(name + ".trace");
    tb::Bench bench(scenario, options, tb::make_pin_execution());
    return bench.run([](tb::Tick) { return true; });
  }

 private:
  std::filesystem::path folder_;
};

TEST_F(MailboxOnTheBench, ReachesDataExchangeByAScenario) {
  const tb::RunResult result = run(tb::Engine::kSkip, "skip");
  EXPECT_EQ(tb::verdict(result), tb::Verdict::kPassed) << tb::summary(result);
  EXPECT_EQ(result.violations, 0U);
  EXPECT_THAT(tb::summary(result), HasSubstr("DATA_EXCH"));
  EXPECT_THAT(tb::result_json(result), HasSubstr(R"("dp_state": "DATA_EXCH")"));
  EXPECT_TRUE(result.checks.empty());
}

TEST_F(MailboxOnTheBench, StepAndSkipGiveTheSamePinsLogAndWave) {
  EXPECT_EQ(tb::verdict(run(tb::Engine::kSkip, "skip")), tb::Verdict::kPassed);
  EXPECT_EQ(tb::verdict(run(tb::Engine::kStep, "step")), tb::Verdict::kPassed);
  EXPECT_EQ(read("skip.trace"), read("step.trace"));
  EXPECT_EQ(read("skip.log"), read("step.log"));
  EXPECT_EQ(read("skip.vcd"), read("step.vcd"));
}

TEST_F(MailboxOnTheBench, ItsPinsAndEventsAreInWaveTraceAndLog) {
  run(tb::Engine::kSkip, "run");
  for (const char* pin : {"RESET", "XSS", "SCK", "MOSI", "PBRXD", "MISO", "INT", "PBTXD", "PBRTS"})
    EXPECT_THAT(read("run.vcd"), HasSubstr(std::string(" ") + pin + " ")) << pin;
  EXPECT_THAT(read("run.trace"), HasSubstr(" box MISO 1\n"));
  EXPECT_THAT(read("run.trace"), HasSubstr(" box INT 0\n"));
  EXPECT_THAT(read("run.log"), HasSubstr("started: address 5, ident 0B0C"));
}

TEST_F(MailboxOnTheBench, AResetOfTheChipStartsItsUserAgain) {
  const std::string text = R"(
name: reset
baud: 12M
end: 20ms
chip: {kind: mailbox}
masters: [{name: plc, address: 1, slaves: [{slave: box}]}]
slaves: [{name: box, address: 5, init: {ident: 0x0B0C, max_inputs: 8, max_outputs: 8, cfg: 17 27}, user_cpu: {cycle: 100us}}]
script: [{at: 9ms, do: reset_chip, slave: box}]
allow: [{event: BUS_CHARACTER_ERROR}, {event: BUS_TELEGRAM_ERROR}]
expect:
  - {slave: box, dp_state: data_exch, by: 8ms}
  - {slave: box, dp_state: offline, at: 9005us}
  - {slave: box, dp_state: data_exch, event: STARTED, count: 2}
)";
  const tb::scenario::Scenario scenario = tb::scenario::parse(text, kScenario);
  tb::Bench bench(scenario, {}, tb::make_pin_execution());
  const tb::RunResult result = bench.run([](tb::Tick) { return true; });
  EXPECT_EQ(tb::verdict(result), tb::Verdict::kPassed) << tb::summary(result);
}

std::string error_of(const std::string& text, const std::vector<std::string>& set = {}) {
  try {
    tb::scenario::parse(text, "x.yaml", tb::scenario::parse_settings(set));
  } catch (const tb::InputError& error) {
    return error.what();
  }
  return "";
}

std::string with(const std::string& chip, const std::string& user_cpu, const std::string& script = "") {
  return "name: x\nbaud: 12M\nend: 1ms\nchip: " + chip +
         "\nslaves:\n  - {name: a, address: 5, init: {ident: 1, max_inputs: 8, max_outputs: 8, cfg: 17 27}, "
         "user_cpu: " +
         user_cpu + "}\n" + script;
}

TEST_F(MailboxOnTheBench, KeysOfOneKindAreNotThoseOfAnother) {
  EXPECT_EQ(error_of(with("{kind: mailbox}", "{sck_period: 1us}")), "");
  EXPECT_THAT(error_of(with("{kind: mailbox}", "{fsmc: {datast: 3}}")), HasSubstr("x.yaml:6: unknown key fsmc"));
  EXPECT_THAT(error_of(with("{kind: mailbox, ready_cycles: 10}", "{}")), HasSubstr("unknown key ready_cycles"));
  EXPECT_THAT(error_of(with("{}", "{sck_period: 1us}")), HasSubstr("x.yaml:6: unknown key sck_period"));
  EXPECT_THAT(error_of(with("{kind: mailbox}", "{}", "script: [{at: 1us, do: wrong_crc, slave: a, area: inputs}]\n")),
              HasSubstr("wrong_crc"));
  EXPECT_THAT(error_of(with("{kind: mailbox}", "{}", "checks: {TIMING_TS: {min: 15ns}}\n")), HasSubstr("TIMING_TS"));
  EXPECT_THAT(error_of(with("{kind: mailbox}", "{}", "allow: [{event: HOST_TS}]\n")), HasSubstr("HOST_TS"));
}

TEST_F(MailboxOnTheBench, NoConfigurationIsLongerThanItHolds) {
  const std::string script = "script: [{at: 1us, do: reinitialise, slave: a, cfg: 17 27 00}]\n";
  EXPECT_THAT(error_of(with("{kind: mailbox}", "{}"), {"slaves.a.init.cfg=17 27 00"}),
              HasSubstr("3 bytes, expected 1 to 2"));
  EXPECT_THAT(error_of(with("{kind: mailbox}", "{}", script)), HasSubstr("3 bytes, expected 1 to 2"));
  EXPECT_EQ(error_of(with("{}", "{}", script)), "");
}

TEST_F(MailboxOnTheBench, AKindThatNobodyKnowsIsRefusedWithTheNamesOfThoseThatThereAre) {
  EXPECT_EQ(error_of(with("{kind: mailbix}", "{}")),
            "x.yaml:4: kind is \"mailbix\" (did you mean mailbox?), expected dsdpv1, dsdpv1_r, dsdpv1_rsu, "
            "apc3, spc3, vpc3, xgate, mailbox");
}

TEST_F(MailboxOnTheBench, TheCommandLineReachesItsKeys) {
  EXPECT_EQ(error_of(with("{kind: mailbox}", "{}"), {"user_cpu.sck_period=2us"}), "");
  EXPECT_EQ(error_of(with("{}", "{}"), {"chip.kind=mailbox", "user_cpu.sck_period=2us"}), "");
  EXPECT_THAT(error_of(with("{}", "{}"), {"user_cpu.sck_period=2us"}), HasSubstr("unknown key sck_period"));
}

}  // namespace
}  // namespace dsdpv1
