// The kit by a small chip: 8 lamps, 8 switches, ECHO of STROBE at once, and INT, which is high-active. It starts itself
// at the first write.
#include "tb/kit/slave_kit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/program.hpp"
#include "io/input/input_error.hpp"
#include "tb/bench/bench.hpp"
#include "tb/bench/verdict.hpp"
#include "tb/report/summary.hpp"

namespace dsdpv1 {
namespace {

using kit::Cycle;
using kit::Level;
using kit::PinNumber;
using kit::Tick;
using testing::ElementsAre;
using testing::HasSubstr;

enum : PinNumber { kStrobe = kit::kOwn, kSwitches, kAlarm, kLamps, kInt, kEcho };

/// STROBE's rise takes switches and alarm at the second edge after it, and ends INT at the first one.
class LampPort : public kit::UserPort {
 public:
  /// `plans`: it keeps the rule of docs/own_slave.md.
  LampPort(kit::Chip& chip, bool plans) : chip_(chip), plans_(plans) {}

  void reset() override { acts_at_ = shows_at_ = profibus::kNever; }
  void input(Tick at, PinNumber pin, Level level) override {
    if (pin == kStrobe) chip_.drive(at, kEcho, level);
    if (pin != kStrobe || level == 0) return;
    due().clear();
    shows_at_ = profibus::first_edge_after(at);
    acts_at_ = shows_at_ + 1;
  }
  void eval(Cycle now) override {
    if (now == shows_at_) shows_at_ = profibus::kNever;
    if (now != acts_at_) return;
    acts_at_ = profibus::kNever;
    if (chip_.slave().state() == profibus::DpState::kOffline) return start(now);
    const auto switches = static_cast<std::uint8_t>(chip_.level(kSwitches));
    chip_.user().new_inputs(now, &switches, 1);
    if (chip_.level(kAlarm) != 0) chip_.user().new_diagnosis(now, 0x81, &switches, 1);
  }
  void show(Cycle now) override {
    chip_.drive_at(now, kInt, due().waiting() ? 1 : 0);
    chip_.drive_at(now, kLamps, chip_.user().outputs().bytes[0]);
  }
  Cycle next() const override { return plans_ ? std::min(acts_at_, shows_at_) : acts_at_; }

 private:
  profibus::Due& due() { return chip_.user().mail().output.due; }
  void start(Cycle now) {
    profibus::SlaveConfig config;
    config.address = 5;
    config.ident = 0x1234;
    config.max_input = config.max_output = config.max_diag = 1;
    config.max_cfg = 1;
    config.cfg_mode = profibus::Judging::kExact;
    const std::uint8_t cfg = 0x30;
    config.cfg.assign(&cfg, 1);
    chip_.user().initialise(now, config);
  }

  kit::Chip& chip_;
  const bool plans_;
  Cycle acts_at_ = profibus::kNever, shows_at_ = profibus::kNever;
};

void strobe(kit::Cpu& cpu, Level switches, Level alarm) {
  cpu.set(kSwitches, switches);
  cpu.set(kAlarm, alarm);
  cpu.set(kStrobe, 1);
  cpu.wait(1000);
  cpu.set(kStrobe, 0);
}

std::vector<Tick> woken;  // since INT rose

/// It sleeps until outputs come.
void program(kit::Cpu& cpu) {
  cpu.wait(10 * bus::kTicksPerUs);
  strobe(cpu, 0, 0);
  for (;;) {
    if (!cpu.wait_interrupt(cpu.now() + bus::kTicksPerMs)) continue;
    woken.push_back(cpu.now());
    cpu.received({static_cast<std::uint8_t>(cpu.level(kLamps))});
    const auto diagnosis = cpu.diagnosis();
    strobe(cpu, diagnosis ? diagnosis->bytes.at(0) : cpu.inputs(1)[0], diagnosis ? Level{1} : Level{0});
    cpu.written();
  }
}

/// STROBE changes at one edge of the clock in four, at some of them with PBRXD.
void strobes(kit::Cpu& cpu) {
  cpu.wait(10 * bus::kTicksPerUs);
  for (Level level = 1;; level = 1 - level) {
    cpu.set(kStrobe, level);
    cpu.wait(4 * profibus::kTicksPerCycle);
  }
}

kit::Parts lamp_parts(const char* name, bool plans) {
  kit::Parts parts;
  parts.name = name;
  parts.title = "8 lamps";
  parts.pins = {{"STROBE", kit::kInput, 0},    {"SWITCHES", kit::kInput, 0, 8}, {"ALARM", kit::kInput, 0},
                {"LAMPS", kit::kOutput, 0, 8}, {"INT", kit::kOutput, 0},        {"ECHO", kit::kOutput, 0}};
  parts.interrupt = kInt;
  parts.capacities = {0, 1, 1, 0};
  parts.diagnosis = true;
  parts.port = [plans](kit::Chip& chip) { return std::make_unique<LampPort>(chip, plans); };
  parts.program = program;
  return parts;
}

kit::Parts strobed_parts() {
  kit::Parts parts = lamp_parts("strobed", true);
  parts.program = strobes;
  return parts;
}

const kit::Kind lamps(lamp_parts("lamps", true)), careless(lamp_parts("careless", false)), strobed(strobed_parts());

class Kit : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    for (const kit::Kind* kind : {&lamps, &careless, &strobed})
      if (tb::find_chip_kind(kind->name()) == nullptr) tb::add_chip_kind(*kind);
  }
  void SetUp() override { woken.clear(); }

  static std::string scenario(const std::string& kind, const std::string& rest) {
    return "name: x\nbaud: 12M\nend: 6ms\nchip: {kind: " + kind +
           "}\nmasters: [{name: plc, slaves: [{slave: a, outputs: '55'}]}]\n"
           "slaves: [{name: a, address: 5, init: {ident: 0x1234, max_inputs: 1, max_outputs: 1, cfg: '30'}}]\n" +
           rest;
  }
  tb::RunResult run(const std::string& text, tb::Engine engine = tb::Engine::kSkip) {
    const tb::scenario::Scenario scenario = tb::scenario::parse(text, "x.yaml");
    tb::RunOptions options;
    options.engine = engine;
    options.trace = trace_;
    options.wave.path = wave_;
    tb::Bench bench(scenario, options, tb::make_pin_execution());
    return bench.run([](Tick) { return true; });
  }
  std::string traced(const std::string& text, tb::Engine engine) { return written(trace_, text, engine); }
  std::string waved(const std::string& text, tb::Engine engine) { return written(wave_, text, engine); }

  std::string trace_, wave_;

 private:
  /// `path` is of an output of the run, one that has none otherwise.
  std::string written(std::string& path, const std::string& text, tb::Engine engine) {
    const auto file = std::filesystem::path(testing::TempDir()) / "kit.vcd";
    path = file.string();
    run(text, engine);
    path.clear();
    std::ostringstream read;
    read << std::ifstream(file).rdbuf();
    std::filesystem::remove(file);
    return read.str();
  }
};

TEST_F(Kit, AProgramSleepsUntilTheInterruptLeavesItsLevelOfRest) {
  const tb::RunResult result = run(scenario("lamps", "expect: [{slave: a, outputs: '55', inputs: '55'}]\n"));
  EXPECT_EQ(tb::verdict(result), tb::Verdict::kPassed) << tb::summary(result);
  ASSERT_GT(woken.size(), 50U);
  for (const Tick at : woken) EXPECT_EQ(at % profibus::kTicksPerCycle, 0) << "INT changes at an edge";
}

TEST_F(Kit, ADiagnosisOfTheScriptReachesTheProgramOnce) {
  const tb::RunResult result =
      run(scenario("lamps",
                   "script: [{at: 3ms, do: set_diagnosis, slave: a, type: external, bytes: '77'}]\n"
                   "expect: [{slave: a, event: DIAG, count: 1, count_at_most: 1}, {slave: a, dp_state: data_exch}]\n"));
  EXPECT_EQ(tb::verdict(result), tb::Verdict::kPassed) << tb::summary(result);
}

TEST_F(Kit, StepFindsWhatAPortDoesNotPlan) {
  const std::string right = scenario("lamps", ""), wrong = scenario("careless", "");
  EXPECT_EQ(traced(right, tb::Engine::kStep), traced(right, tb::Engine::kSkip));
  EXPECT_NE(traced(wrong, tb::Engine::kStep), traced(wrong, tb::Engine::kSkip)) << "INT falls late in skip";
}

/// Outputs that an input changes come after PBRXD if both change at one tick.
TEST_F(Kit, WavesOfBothEnginesHaveOneOrderWithinATick) {
  const std::string text = scenario("strobed", "");
  EXPECT_TRUE(waved(text, tb::Engine::kStep) == waved(text, tb::Engine::kSkip));
}

TEST_F(Kit, AWrongRecordIsRefused) {
  const auto refused = [](const std::function<void(kit::Parts&)>& spoil) -> std::string {
    kit::Parts parts = lamp_parts("x", true);
    spoil(parts);
    try {
      kit::Kind kind(parts);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refused([](kit::Parts&) {}), "");
  EXPECT_EQ(refused([](kit::Parts& parts) { parts.name = nullptr; }), "kit::Kind : no name or no title");
  EXPECT_EQ(refused([](kit::Parts& parts) { parts.port = nullptr; }), "kit::Kind x: no port or no program");
  EXPECT_EQ(refused([](kit::Parts& parts) { parts.interrupt = kSwitches; }),
            "kit::Kind x: the interrupt is no output of its own");
  EXPECT_EQ(refused([](kit::Parts& parts) { parts.interrupt = kit::kTxd; }),
            "kit::Kind x: the interrupt is no output of its own");
  EXPECT_EQ(refused([](kit::Parts& parts) {
              parts.pins.resize(28, {"P", kit::kInput, 0});
            }),
            "kit::Kind x: 28 pins, expected at most 27");
  static const profibus::ReasonRow rows[] = {{profibus::Severity::kInfo, "LAMP_ON", "", "on", ""},
                                             {profibus::Severity::kInfo, "LAMP_ON", "", "still on", ""},
                                             {profibus::Severity::kInfo, "PRM_IDENT", "", "off", ""}};
  EXPECT_EQ(refused([](kit::Parts& parts) {
              parts.reasons = {rows, 2};
            }),
            "kit::Kind x: two of its reasons have the code LAMP_ON");
  EXPECT_EQ(refused([](kit::Parts& parts) {
              parts.reasons = {rows + 1, 2};
            }),
            "kit::Kind x: two of its reasons have the code PRM_IDENT");
}

tb::ChipKinds wrong_kinds() {
  static const kit::Kind kind(kit::Parts{"x", "no port"});
  return {&kind};
}

TEST_F(Kit, AProgramRefusesAWrongRecordWithOneLine) {
  char name[] = "x", command[] = "schema";
  char* words[] = {name, command, nullptr};
  EXPECT_EXIT(std::exit(app::program(2, words, "x", wrong_kinds)), testing::ExitedWithCode(2),
              "^x: kit::Kind x: no port or no program\n$");
}

kit::Parts parts() { return lamp_parts("derived", true); }

class Derived : public kit::Kind {
 public:
  Derived() : kit::Kind(parts()) {}
};

TEST_F(Kit, ADerivedKindIsMadeByAFunctionOfAnyName) { EXPECT_STREQ(Derived().name(), "derived"); }

TEST_F(Kit, AScenarioWantsNoMoreBytesThanTheChipHolds) {
  const auto refused = [](const std::string& text) -> std::string {
    try {
      tb::scenario::parse(text, "x.yaml");
    } catch (const tb::InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto with = [](const char* key) {
    std::string text = scenario("lamps", "");
    return text.replace(text.find(std::string(key) + ": 1") + std::strlen(key) + 2, 1, "2");
  };
  EXPECT_EQ(refused(with("max_inputs")), "x.yaml:6: max_inputs of 2 bytes, but lamps holds 1");
  EXPECT_EQ(refused(with("max_outputs")), "x.yaml:6: max_outputs of 2 bytes, but lamps holds 1");
  const std::string script = "script: [{at: 1us, do: set_inputs, slave: a, bytes: 01 02}]\n";
  EXPECT_EQ(refused(scenario("lamps", script)), "x.yaml:7: set_inputs of 2 bytes, but lamps holds 1");
}

}  // namespace
}  // namespace dsdpv1
