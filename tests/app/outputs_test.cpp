// What the program writes: help, result file, waves, log, and all of it complete when a run is interrupted.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"

namespace {

using app_test::call;
using app_test::read;

const char* const kScenario =
    "name: short\nbaud: 12M\nend: 3ms\n"
    "slaves:\n  - {name: demo, address: 5, init: {ident: 1, max_inputs: 2, max_outputs: 2, cfg: \"31\"}}\n"
    "masters:\n  - {name: plc, address: 2, slaves: [{slave: demo, outputs: \"01 02\"}]}\n"
    "expect:\n  - {slave: demo, dp_state: data_exch}\n";

class Outputs : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_.file(name)) << text; }
  app_test::Called run(const std::string& arguments) const { return call("run s.yaml " + arguments, folder_.path()); }
  app_test::Folder folder_;
};

TEST_F(Outputs, EveryCommandHasHelpWithExamples) {
  for (const char* command : {"", "run", "schema", "gsd", "decode"}) {
    const app_test::Called called = call(std::string(command) + " --help", folder_.path());
    EXPECT_EQ(called.status, 0) << command;
    EXPECT_NE(called.out.find("Examples:"), std::string::npos) << command;
  }
  EXPECT_EQ(call("--version", folder_.path()).out.substr(0, 11), "dsdpv1-sim ");
}

TEST_F(Outputs, ResultHoldsWhatItMust) {
  write("s.yaml", kScenario);
  const app_test::Called called = run("--result r.json --log l.txt");
  ASSERT_EQ(called.status, 0) << called.err << called.out;
  EXPECT_NE(called.out.find("PASSED"), std::string::npos);
  const auto result = nlohmann::json::parse(read(folder_.file("r.json")));
  EXPECT_EQ(result["passed"], true);
  EXPECT_EQ(result["simulated_ns"], 3'000'000);
  EXPECT_EQ(result["chip_cycles"], 144'000);
  for (const char* key : {"wall_s", "real_time_factor", "telegrams", "engine", "view", "events", "expectations"})
    EXPECT_TRUE(result.contains(key)) << key;
  const auto& slave = result["slaves"].at(0);
  EXPECT_EQ(slave["dp_state"], "DATA_EXCH");
  EXPECT_EQ(slave["baud"], "12M");
  EXPECT_GT(slave["data_exchanges"], 10);
  EXPECT_LT(slave["outputs_overwritten"], slave["data_exchanges"]);
  EXPECT_GE(slave["tsdr"]["min_bits"], 11.0);
  EXPECT_EQ(slave["outputs"], "01 02");
  EXPECT_EQ(result["expectations"].at(0)["passed"], true);
  EXPECT_NE(read(folder_.file("l.txt")).find("DATA_EXCH"), std::string::npos);
}

TEST_F(Outputs, UnmetExpectationFailsTheRunAndIsNamed) {
  write("s.yaml", std::string(kScenario) + "  - {slave: demo, dp_state: wait_prm}\n");
  const app_test::Called called = run("--result r.json");
  EXPECT_EQ(called.status, 1);
  EXPECT_NE(called.out.find("NOT MET  s.yaml:10: demo: dp_state WAIT_PRM at the end; seen: dp_state DATA_EXCH"),
            std::string::npos)
      << called.out;
  EXPECT_EQ(nlohmann::json::parse(read(folder_.file("r.json")))["passed"], false);
}

TEST_F(Outputs, ViolationThatIsNotAllowedFailsTheRun) {
  std::string text = kScenario;
  text.replace(text.find("cfg: \"31\"}"), 10, "cfg: \"31\"}, user_cpu: {access: {wr_low: 10ns}}");
  text.erase(text.find("expect:"));
  write("s.yaml", text);
  EXPECT_EQ(run("").status, 1);
  write("s.yaml", text +
                      "allow: [{event: HOST_TS}, {event: HOST_TD_SETUP}, {event: HOST_READ_UNKNOWN}, {event: "
                      "HOST_READ_IN_FLIGHT}]\n");
  EXPECT_EQ(run("").status, 0);
}

TEST_F(Outputs, QuietPrintsNothing) {
  write("s.yaml", kScenario);
  EXPECT_EQ(run("--quiet --no-progress").out, "");
}

TEST_F(Outputs, WavesShowThePinsTheLineAndTheStates) {
  write("s.yaml", kScenario);
  ASSERT_EQ(run("--wave w.vcd --quiet").status, 0);
  const std::string wave = read(folder_.file("w.vcd"));
  for (const char* part : {"$timescale 1 ps $end", " L_REQ $end", " D [7:0] $end", " A [10:0] $end", " PBTXD $end",
                           " line $end", "sDATA_EXCH ", "bzzzzzzzz ", "bxxxxxxxx "}) {
    EXPECT_NE(wave.find(part), std::string::npos) << part;
  }
}

TEST_F(Outputs, SameRunGivesTheSameFiles) {
  write("s.yaml", kScenario);
  for (const char* name : {"a", "b"}) {
    const std::string n = name;
    ASSERT_EQ(run("--quiet --wave " + n + ".vcd --log " + n + ".log --trace " + n + ".txt").status, 0);
  }
  for (const char* ending : {".vcd", ".log", ".txt"})
    EXPECT_TRUE(read(folder_.file(std::string("a") + ending)) == read(folder_.file(std::string("b") + ending)))
        << ending;
}

TEST_F(Outputs, InterruptedRunLeavesCompleteFilesAndExits130) {
  std::string text = kScenario;
  text.replace(text.find("3ms"), 3, "3000s");
  write("s.yaml", text);
  // After a second of a run that would take hours; more than once, as shells and `timeout` do.
  for (const char* view : {"pins", "tlm"}) {
    const std::string command =
        "cd '" + folder_.path().string() +
        "' && { '" DSDPV1_SIM "' run s.yaml --quiet --wave w.vcd --log l.txt --result r.json --view " + view +
        " & sleep 1; i=0; while [ $i -lt 300 ]; do kill -INT $! 2>/dev/null; i=$((i+1)); done; wait $!; }";
    const int status = std::system(command.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 130) << view;
    const auto result = nlohmann::json::parse(read(folder_.file("r.json")));
    EXPECT_EQ(result["interrupted"], true);
    EXPECT_EQ(result["passed"], false);
    const std::string wave = read(folder_.file("w.vcd"));
    ASSERT_FALSE(wave.empty());
    EXPECT_EQ(wave.back(), '\n');
    EXPECT_FALSE(std::filesystem::exists(folder_.file("w.vcd.part")));
    EXPECT_FALSE(read(folder_.file("l.txt")).empty());
  }
}

}  // namespace
