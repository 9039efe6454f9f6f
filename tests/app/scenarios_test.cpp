// Every shipped scenario passes, including the checks, with the pins of its golden trace in step and skip. Step, skip
// and TLM give the same bytes: log and result, and in TLM the trace of the outputs; and log and result without a trace,
// when the line's changes are not needed. The results match the schema. User CPUs that move pins have no TLM.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tb/scenario/scenario.hpp"
#include "tests/app/program.hpp"

namespace dsdpv1 {
namespace {

using app_test::call;
using app_test::read;
using app_test::shipped_scenarios;

const std::string kGolden = " --golden traces";

class Scenarios : public testing::TestWithParam<std::string> {
 protected:
  /// Runs the scenario and says whether it passed. Its files are called engine_view and `suffix`.
  bool run(const std::string& engine, const std::string& view, const std::string& options = "",
           const std::string& suffix = "", const std::string& checks = "fail") const {
    const std::string name = engine + "_" + view + suffix;
    const app_test::Called called =
        call("run scenarios/" + GetParam() + ".yaml --no-progress --checks " + checks + " --engine " + engine +
                 " --view " + view + options + " --log '" + folder_.file(name + ".log") + "' --result '" +
                 folder_.file(name + ".json") + "'",
             DSDPV1_SOURCE_DIR);
    if (called.status != 0) std::cout << called.out << called.err;
    return called.status == 0;
  }
  std::string trace(const std::string& name) const { return " --trace '" + folder_.file(name + ".trace") + "'"; }
  void expect_same(const std::string& name, const std::string& ending, const std::string& as = "skip_pins") const {
    EXPECT_TRUE(read(folder_.file(as + ending)) == read(folder_.file(name + ending))) << name << ending;
  }
  void expect_same(const std::string& name) const { expect_same_results(name, "skip_pins"); }
  void expect_same_results(const std::string& name, const std::string& as) const {
    expect_same(name, ".log", as);
    EXPECT_EQ(result(as), result(name)) << name;
  }
  /// Without values that identify the run.
  nlohmann::json result(const std::string& name) const {
    nlohmann::json result = nlohmann::json::parse(read(folder_.file(name + ".json")));
    for (const char* key : {"engine", "view", "wall_s", "real_time_factor"}) result.erase(key);
    return result;
  }
  void expect_result_as_the_schema_says(const std::string& name) const {
    const std::string command = "'" DSDPV1_SOURCE_DIR "/.venv/bin/python' -B '" DSDPV1_SOURCE_DIR
                                "/tests/report/validate.py' '" +
                                app_test::simulator() + "' '" + folder_.file(name + ".json") + "'";
    EXPECT_EQ(std::system(command.c_str()), 0);
  }
  app_test::Folder folder_;
};

std::vector<std::string> views(const std::string& scenario) {
  const auto loaded = tb::scenario::load(DSDPV1_SOURCE_DIR "/scenarios/" + scenario + ".yaml");
  return needs_pins(loaded) ? std::vector<std::string>{"pins"} : std::vector<std::string>{"pins", "tlm"};
}

TEST_P(Scenarios, PassesAndStepSkipAndTlmAreTheSame) {
  ASSERT_TRUE(run("skip", "pins", kGolden + trace("skip_pins")));
  ASSERT_TRUE(run("step", "pins", kGolden));
  expect_same("step_pins");
  for (const std::string& view : views(GetParam())) {
    const std::string name = "skip_" + view;
    if (view == "tlm") {
      ASSERT_TRUE(run("skip", view, trace(name)));
      expect_same(name, ".trace");
      expect_same(name);
    }
    ASSERT_TRUE(run("skip", view, "", "_untraced"));
    expect_same(name + "_untraced");
    // Without checks the pins of the host's accesses are not observed, so these runs execute each at once, or ahead of
    // simulation time.
    ASSERT_TRUE(run("skip", view, "", "_unchecked", "off"));
    expect_same_results(name + "_unchecked", "skip_pins_unchecked");
  }
  expect_result_as_the_schema_says("skip_pins");  // so do the equal ones
}

INSTANTIATE_TEST_SUITE_P(All, Scenarios, testing::ValuesIn(shipped_scenarios()),
                         [](const auto& each) { return each.param; });

TEST(ShippedScenarios, AreAllFound) { EXPECT_GE(shipped_scenarios().size(), 12U); }

class BaudRates : public testing::TestWithParam<const char*> {};

TEST_P(BaudRates, PowerOnToDataExchange) {
  const app_test::Folder folder;
  std::ofstream(folder.file("s.yaml")) << "name: rate\nbaud: " << GetParam()
                                       << "\nend: 4s\nchip: {search_window_ms: 5}\n"
                                       << "slaves:\n  - {name: demo, address: 5, init: {ident: 1, max_inputs: 2, "
                                          "max_outputs: 2, cfg: \"31\"}, user_cpu: {cycle: 1ms}}\n"
                                       << "masters:\n  - {name: plc, address: 2, bus: {gap_factor: 0, "
                                          "min_slave_interval: 10000}, slaves: [{slave: demo, outputs: \"01 02\"}]}\n"
                                       << "expect:\n  - {slave: demo, dp_state: data_exch, baud: " << GetParam()
                                       << ", inputs: \"01 02\", tsdr_min: 11, tsdr_max: 13}\n";
  const app_test::Called called = call("run s.yaml --no-progress", folder.path());
  EXPECT_EQ(called.status, 0) << called.out << called.err;
}

INSTANTIATE_TEST_SUITE_P(All, BaudRates,
                         testing::Values("12M", "6M", "3M", "1.5M", "500k", "187.5k", "93.75k", "45.45k", "19.2k",
                                         "9.6k"));

// R1: DSDPV1-R, and DSDPV1-RSU in parallel mode, are the DSDPV1.
TEST(Kinds, SistersInParallelModeDoTheSame) {
  const app_test::Folder folder;
  for (const std::string kind : {"dsdpv1", "dsdpv1_r", "dsdpv1_rsu"}) {
    const app_test::Called called =
        call("run scenarios/dpv1_c1.yaml --no-progress --set chip.kind=" + kind + " --log '" + folder.file(kind) + "'",
             DSDPV1_SOURCE_DIR);
    EXPECT_EQ(called.status, 0) << called.err;
    EXPECT_TRUE(read(folder.file(kind)) == read(folder.file("dsdpv1"))) << kind;
  }
}

TEST(Kinds, WhatTheRsuDoesNotTakeIsSaid) {
  const auto error = [](const std::string& options) {
    const app_test::Called called =
        call("run scenarios/diagnosis.yaml --no-progress --set chip.kind=dsdpv1_rsu" + options, DSDPV1_SOURCE_DIR);
    EXPECT_EQ(called.status, 2) << options;
    return called.err;
  };
  EXPECT_NE(error(" --set chip.u_timer=47").find("u_timer is 47, expected 0 or"), std::string::npos);
  EXPECT_NE(error(" --set 'chip.uart_gaps=[1,2,3]'").find("uart_gaps has 3 items"), std::string::npos);
  EXPECT_NE(error(" --set 'chip.uart_gaps=[7,2,4,10,20,40,100,1001]'").find("from 1 to 1000 half characters"),
            std::string::npos);
}

}  // namespace
}  // namespace dsdpv1
