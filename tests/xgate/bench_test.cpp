// The XGate-DPS10 on the bench, with its host by UART and SPI.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tb/bench/bench.hpp"
#include "tb/bench/verdict.hpp"
#include "tb/report/summary.hpp"

namespace dsdpv1::xgate {
namespace {

using testing::HasSubstr;

/// Short times: 10 ms of power-up and 50 ms of a wrong rate's search would only make the runs longer.
constexpr const char* kScenario = R"(
name: xgate
baud: 12M
end: 16ms
chip: {kind: xgate, rate: 1000000, answer_delay: 20us, power_up: 1ms, host_shown: 1ms}
masters: [{name: plc, address: 1, bus: {min_slave_interval: 200}, slaves: [{slave: m, outputs: 01 02 03, dpv1: true}]}]
slaves:
  - name: m
    address: 6
    init: {ident: 0x0F01, max_inputs: 3, max_outputs: 3, cfg: 12 22, dpv1: true}
    user_cpu: {cycle: 500us, dpv1: {objects: [{slot: 1, index: 2, data: "01 02 03 04"}]}}
)";
constexpr const char* kUse = R"(
script:
  - {at: 9ms, do: c1_read, slave: m, slot: 1, index: 2, length: 4}
  - {at: 11ms, do: set_diagnosis, slave: m, type: external, bytes: "41 01"}
expect:
  - {slave: m, outputs: 01 02 03, inputs: 01 02 03, by: 9ms}
  - {reply_of: c1_read, reply: "01 02 03 04", by: 11ms}
  - {slave: m, event: XGATE_ERR_MODULE, count: 1}
  - {slave: m, dp_state: data_exch}
)";

class XgateOnTheBench : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    for (char& letter : name) letter = letter == '/' ? '_' : letter;
    folder_ = std::filesystem::path(testing::TempDir()) / ("xgate_" + name);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string read(const std::string& name) const {
    std::ifstream in(folder_ / name);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }
  bool has(const std::string& name, const std::string& text) const {
    return read(name).find(text) != std::string::npos;
  }
  tb::RunResult run(const std::string& rest, std::vector<std::string> set = {}, tb::Engine engine = tb::Engine::kSkip,
                    const std::string& name = "run") const {
    const tb::scenario::Scenario scenario =
        tb::scenario::parse(kScenario + rest, "x.yaml", tb::scenario::parse_settings(set));
    tb::RunOptions options;
    options.engine = engine;
    options.wave.path = (folder_ / (name + ".vcd")).string();
    options.log = (folder_ / (name + ".log")).string();
    options.trace = (folder_ / (name + ".trace")).string();
    tb::Bench bench(scenario, options, tb::make_pin_execution());
    return bench.run([](tb::Tick) { return true; });
  }

 private:
  std::filesystem::path folder_;
};

/// Its settings, separated by spaces.
std::vector<std::string> settings_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> all;
  for (std::string each; in >> each;) all.push_back(each);
  return all;
}

TEST_P(XgateOnTheBench, EveryChoiceReachesDataExchangeAlikeInStepAndSkip) {
  const tb::RunResult skip = run(kUse, settings_of(GetParam()), tb::Engine::kSkip, "skip");
  EXPECT_EQ(tb::verdict(skip), tb::Verdict::kPassed) << tb::summary(skip);
  run(kUse, settings_of(GetParam()), tb::Engine::kStep, "step");
  EXPECT_TRUE(read("skip.trace") == read("step.trace"));
  EXPECT_TRUE(read("skip.log") == read("step.log"));
  EXPECT_TRUE(read("skip.vcd") == read("step.vcd"));
}

INSTANTIATE_TEST_SUITE_P(
    Choices, XgateOnTheBench,
    testing::Values("chip.port=uart", "chip.rate=3000000 chip.errors=printed chip.mailboxes=short",
                    "user_cpu.any_cfg=true chip.c1_id=7 chip.c2_id=9 chip.mailbox_special=165",
                    "chip.port=spi chip.spi_mode=0 user_cpu.spi.clock=6000",
                    "chip.port=spi chip.spi_mode=1 user_cpu.spi.mosi_delay=100ns",
                    "chip.port=spi chip.spi_mode=2 user_cpu.spi.byte_gap=1us chip.errors=printed",
                    "chip.port=spi chip.spi_mode=3 chip.mailboxes=short chip.answer_delay=0ns",
                    "chip.answer_delay=0ns chip.rate=921600 chip.watchdog=host chip.step_answer=example"));

TEST_F(XgateOnTheBench, FramesAreInLogAndWave) {
  run(kUse);
  for (const char* line :
       {"04 initialise, 21 bytes", "04 initialise, 0 bytes", "20 error 3/3: data exchange",
        "21 outputs, new user parameters, 3 bytes", "21 exchange, user parameters known", "22 read user parameters, 0",
        "30 requests: id 1, read slot 1 index 2 length 4", "30 answers: id 1, read slot 1 index 2 length 4",
        "31 error 4/2: parameter of the command", "XGATE_ERR_MODULE: command 31: the module's error 4/2"})
    EXPECT_TRUE(has("run.log", line)) << line;
  for (const char* signal : {"uart_request", "uart_reply", "RXD", "TXD", "INT", "LED1A", "LED2B"})
    EXPECT_TRUE(has("run.vcd", std::string(" ") + signal + " ")) << signal;
  EXPECT_FALSE(has("run.log", "XGATE_LOST"));
}

/// 9.5 bits after the start bit the sample must still be in the stop bit: 5 %.
TEST_F(XgateOnTheBench, AHostAtAnotherRateIsHeardUpToHalfABit) {
  for (const char* near : {"970000", "1030000"}) {
    // A quick host begins before the module's stop bit has ended.
    const tb::RunResult result =
        run(std::string(kUse) + "allow: [{event: ANSWER_AWAITED}]\n", {std::string("user_cpu.rate=") + near});
    EXPECT_EQ(tb::verdict(result), tb::Verdict::kPassed) << near << tb::summary(result);
  }
  for (const char* far : {"900000", "1200000"}) {
    run("expect: none\nallow: [{event: XGATE_CHARACTER}]\n",
        {std::string("user_cpu.rate=") + far, "user_cpu.answer_ms=1", "user_cpu.byte_ms=1"});
    EXPECT_TRUE(has("run.log", "XGATE_ERR_SILENT: command 04")) << far;
  }
  EXPECT_FALSE(has("run.log", "04 initialise, 0 bytes"));
}

TEST_F(XgateOnTheBench, IspCfgLowKeepsTheModuleSilent) {
  const tb::RunResult result =
      run("expect: none\n", {"chip.isp_cfg_low=true", "user_cpu.answer_ms=1", "user_cpu.byte_ms=1", "end=12ms"});
  EXPECT_THAT(tb::summary(result), HasSubstr("OFFLINE"));
  EXPECT_TRUE(has("run.log", "XGATE_ERR_SILENT"));
  EXPECT_TRUE(has("run.trace", " LED2A 1\n")) << "X25";
  EXPECT_TRUE(has("run.trace", " LED2B 1\n"));
}

/// A gap after each byte that is longer than the module's (X4): it has no command to answer.
TEST_F(XgateOnTheBench, AHostThatIsTooSlowCutsItsFrames) {
  run("expect: none\n", {"chip.frame_gap=100us", "user_cpu.byte_gap=200us", "user_cpu.repetitions=0", "end=6ms"});
  EXPECT_TRUE(has("run.log", "no frame  [wrong: cut after 1 bytes]  7E"));
  EXPECT_FALSE(has("run.log", "04 initialise"));
  run("expect: none\n", {"chip.frame_gap=300us", "user_cpu.byte_gap=200us", "user_cpu.repetitions=0", "end=8ms"});
  EXPECT_TRUE(has("run.log", "04 initialise, 0 bytes"));
}

TEST_F(XgateOnTheBench, AResetOrANewInitialisationBeginsAgain) {
  const std::string rest = R"(
script: [{at: 6ms, do: reset_chip, slave: m}, {at: 11ms, do: reinitialise, slave: m}]
allow: [{event: BUS_CHARACTER_ERROR}, {event: BUS_TELEGRAM_ERROR}]
expect:
  - {slave: m, dp_state: data_exch, by: 5ms}
  - {slave: m, dp_state: offline, at: 6500us}
  - {slave: m, dp_state: data_exch, by: 10ms}
  - {slave: m, outputs: 01 02 03, inputs: 01 02 03, at: 15ms}
)";
  const tb::RunResult result = run(rest);
  EXPECT_EQ(tb::verdict(result), tb::Verdict::kPassed) << tb::summary(result);
}

}  // namespace
}  // namespace dsdpv1::xgate
