// The program's output: help, result file, waves, log; all complete if a run is interrupted.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/app/program.hpp"

namespace dsdpv1 {
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
  for (const char* command : {"", "demo", "run", "schema", "gsd", "decode", "rtl-faults", "recover"}) {
    const app_test::Called called = call(std::string(command) + " --help", folder_.path());
    EXPECT_EQ(called.status, 0) << command;
    EXPECT_NE(called.out.find("Examples:"), std::string::npos) << command;
  }
  EXPECT_EQ(call("--version", folder_.path()).out.substr(0, 11), "dsdpv1-sim ");
}

TEST_F(Outputs, DemoLeavesItsFilesInAFolderAndSaysWhere) {
  for (const char* time : {"first", "again, over its own files"}) {
    const app_test::Called called = call("demo", folder_.path());
    ASSERT_EQ(called.status, 0) << time << called.err;
    EXPECT_NE(called.out.find("\nPASSED\nFiles: " + folder_.file("out/power_on_12m")), std::string::npos) << called.out;
    const auto result = nlohmann::json::parse(read(folder_.file("out/power_on_12m.json")));
    EXPECT_TRUE(result.at("passed").get<bool>()) << time;
    EXPECT_GT(std::filesystem::file_size(folder_.file("out/power_on_12m.log")), 10000U) << time;
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.file("out")), {}), 3) << time;
  }
}

TEST_F(Outputs, DemoRefusesWhatIsNoFolderInOneLine) {
  write("out", "a file");
  for (const char* arguments :
       {"demo", "demo --out out/below", "demo --out /proc/nowhere", "demo --out ''", "demo now"}) {
    const app_test::Called called = call(arguments, folder_.path());
    EXPECT_EQ(called.status, 2) << arguments;
    EXPECT_EQ(called.out, "") << arguments;
    EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
  }
  EXPECT_EQ(read(folder_.file("out")), "a file");
}

TEST_F(Outputs, JunitHasTheRunItsViolationsAndEachExpectation) {
  write("s.yaml", kScenario);
  EXPECT_EQ(run("--junit j.xml --quiet").status, 0);
  const std::string passed = read(folder_.file("j.xml"));
  EXPECT_NE(passed.find(R"( failures="0")"), std::string::npos) << passed;
  EXPECT_NE(passed.find(R"(classname="s.yaml" name="demo: TIMING_TS")"), std::string::npos) << passed;
  EXPECT_NE(passed.find(R"(classname="s.yaml" name="line 9: )"), std::string::npos) << passed;
  EXPECT_EQ(run("--junit j.xml --quiet --set end=100us").status, 1);
  EXPECT_NE(read(folder_.file("j.xml")).find(R"( failures="2")"), std::string::npos);
  EXPECT_EQ(run("--junit s.yaml").status, 2) << "it would replace the scenario";
  EXPECT_EQ(run("--junit none.xml --set baud=7M").status, 2);
  EXPECT_FALSE(std::filesystem::exists(folder_.file("none.xml")));
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
  EXPECT_EQ(result["masters"].at(0)["min_slave_interval_from"], nullptr) << "no GSD, no wish";
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
  write("s.yaml",
        text +
            "expect: none\nallow: [{event: HOST_TS}, {event: HOST_TD_SETUP}, {event: HOST_READ_UNKNOWN}, {event: "
            "HOST_READ_IN_FLIGHT}, {event: HOST_SETS_BIT}]\n");
  EXPECT_EQ(run("--checks report").status, 0);
}

TEST_F(Outputs, SamplesBeforeTwAreReportedTheSameInEveryExecution) {
  // By the FSMC RD rises together with CSR.
  for (const char* timing : {"access: {rd_sample: 31ns}", "fsmc: {mode: A, datast: 1}"}) {
    std::string text = kScenario;
    text.replace(text.find("cfg: \"31\"}"), 10, std::string("cfg: \"31\"}, user_cpu: {") + timing + "}");
    text.erase(text.find("expect:"));
    write("s.yaml", text);
    EXPECT_EQ(run("--quiet --log skip.log --trace skip.txt").status, 1);
    EXPECT_NE(read(folder_.file("skip.log")).find("Tw: D was sampled"), std::string::npos) << timing;
    for (const char* other : {"--engine step", "--view tlm"}) {
      EXPECT_EQ(run(std::string("--quiet --log other.log --trace other.txt ") + other).status, 1);
      EXPECT_TRUE(read(folder_.file("skip.log")) == read(folder_.file("other.log"))) << timing << " " << other;
      EXPECT_TRUE(read(folder_.file("skip.txt")) == read(folder_.file("other.txt"))) << timing << " " << other;
    }
  }
}

TEST_F(Outputs, RefusalsStandInTheTableAndTheResult) {
  std::string text = kScenario;
  text.replace(text.find("{slave: demo, outputs"), 12, "{slave: demo, cfg: \"33\"");
  text.replace(text.find("expect:"), std::string::npos, "expect: none\n");
  write("s.yaml", text);
  const app_test::Called called = run("--result r.json");
  EXPECT_EQ(called.status, 3) << "a refusal is no violation";
  const auto refused = nlohmann::json::parse(read(folder_.file("r.json")))["refused"];
  ASSERT_EQ(refused.size(), 1U) << refused;
  EXPECT_EQ(refused.at(0)["code"], "CFG_IO_LENGTH");
  EXPECT_EQ(refused.at(0)["slave"], "demo");
  const std::int64_t count = refused.at(0)["count"];
  EXPECT_GT(count, 1);
  EXPECT_LT(refused.at(0)["first_ns"], refused.at(0)["last_ns"]);
  std::string times = std::to_string(count);
  times.insert(0, std::string("times").size() - times.size(), ' ');  // right-aligned
  EXPECT_NE(called.out.find("  demo        CFG_IO_LENGTH  " + times + "  "), std::string::npos) << called.out;
}

TEST_F(Outputs, PollRateIsThatOfTheGsdUnlessTheScenarioHasItsOwn) {
  std::string text = kScenario;
  const std::string init = "init: {ident: 1, max_inputs: 2, max_outputs: 2, cfg: \"31\"}";
  text.replace(text.find(init), init.size(),
               "gsd: " DSDPV1_SOURCE_DIR "/scenarios/dsdpv1.gsd, modules: [\"2 bytes in, 2 bytes out\"]");
  text.replace(text.find("3ms"), 3, "9ms");
  write("s.yaml", text);
  const app_test::Called from_gsd = run("--result gsd.json");
  EXPECT_EQ(from_gsd.status, 0) << from_gsd.out;
  EXPECT_NE(from_gsd.out.find("600 us or more each (Min_Slave_Intervall of its slaves)"), std::string::npos);
  EXPECT_EQ(run("--result own.json --quiet --set masters.plc.bus.min_slave_interval=0").status, 0);
  const auto gsd = nlohmann::json::parse(read(folder_.file("gsd.json"))),
             own = nlohmann::json::parse(read(folder_.file("own.json")));
  EXPECT_EQ(gsd["masters"].at(0)["min_slave_interval_us"], 600);
  EXPECT_EQ(gsd["masters"].at(0)["min_slave_interval_from"], "gsd");
  EXPECT_EQ(own["masters"].at(0)["min_slave_interval_us"], 0);
  EXPECT_EQ(own["masters"].at(0)["min_slave_interval_from"], "scenario");
  EXPECT_LE(gsd["masters"].at(0)["cycles"], 15);
  EXPECT_GT(own["masters"].at(0)["cycles"], 60);
}

/// The scenario with an exchange of telegrams longer than the log shows them.
std::string with_long_outputs() {
  std::string text = kScenario;
  text.replace(text.find("max_outputs: 2"), 14, "max_outputs: 40");
  text.replace(text.find("cfg: \"31\""), 9, "cfg: \"11 A7 AF A7 A7\"");
  text.replace(text.find("01 02"), 5, "A5*40");
  return text;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST_F(Outputs, LogIsCutUnlessTheWholeIsAskedFor) {
  write("s.yaml", with_long_outputs());
  ASSERT_EQ(run("--quiet --log cut.log").status, 0);
  ASSERT_EQ(run("--quiet --log whole.log --log-whole").status, 0);
  const std::string cut = read(folder_.file("cut.log")), whole = read(folder_.file("whole.log"));
  EXPECT_GT(count_of(cut, " A5 A5 ... (49 bytes)\n"), 10U);
  EXPECT_GT(count_of(cut, "outputs A5 A5"), 0U);
  EXPECT_EQ(count_of(whole, "... ("), 0U);
  EXPECT_EQ(count_of(whole, "\n"), count_of(cut, "\n"));
  const std::string all = "outputs" + [] {
    std::string text;
    for (int i = 0; i < 40; ++i) text += " A5";
    return text;
  }();
  EXPECT_GT(count_of(whole, all + "\n"), 0U);
  const app_test::Called decoded = call("decode whole.log", folder_.path());
  EXPECT_EQ(decoded.status, 0) << decoded.err;
  EXPECT_EQ(count_of(decoded.out, "\ntelegram ") + 1, count_of(whole, " telegram "));
  EXPECT_EQ(call("decode cut.log", folder_.path()).status, 1);
}

TEST_F(Outputs, LogAsJsonLinesTellsTheSame) {
  write("s.yaml", with_long_outputs());
  ASSERT_EQ(run("--quiet --log l.jsonl").status, 0);
  ASSERT_EQ(run("--quiet --log l.log --log-whole").status, 0);
  std::istringstream lines(read(folder_.file("l.jsonl"))), texts(read(folder_.file("l.log")));
  std::size_t telegrams = 0;
  for (std::string line, text; std::getline(texts, text);) {
    ASSERT_TRUE(std::getline(lines, line));
    const auto json = nlohmann::json::parse(line);
    std::istringstream words(text);
    double at = 0;
    std::string unit, station, kind;
    words >> at >> unit >> station >> kind;
    EXPECT_EQ(json["at_ns"], at);
    EXPECT_EQ(json["station"], station);
    EXPECT_EQ(json["kind"], kind);
    EXPECT_NE(text.find(json["text"].get<std::string>()), std::string::npos) << line;
    for (const char* key : {"code", "bytes"}) EXPECT_NE(text.find(json.value(key, "")), std::string::npos) << line;
    EXPECT_EQ(json.contains("bytes"), kind == "telegram" || kind == "user" || kind == "inputs") << line;
    EXPECT_EQ(json.contains("tsdr_bits"), text.find("[TSDR ") != std::string::npos) << line;
    telegrams += kind == "telegram" ? 1 : 0;
  }
  EXPECT_GT(telegrams, 20U);
  EXPECT_EQ(call("decode l.jsonl", folder_.path()).out, call("decode l.log", folder_.path()).out);
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
                           " line $end", "sDATA_EXCH ", "bzzzzzzzz ", "bxxxxxxxx "})
    EXPECT_NE(wave.find(part), std::string::npos) << part;
}

TEST_F(Outputs, SameRunGivesTheSameFiles) {
  write("s.yaml", kScenario);
  for (const char* name : {"a", "b"})
    ASSERT_EQ(run(fmt::format("--quiet --wave {0}.vcd --log {0}.log --trace {0}.txt", name)).status, 0);
  for (const char* ending : {".vcd", ".log", ".txt"})
    EXPECT_TRUE(read(folder_.file(std::string("a") + ending)) == read(folder_.file(std::string("b") + ending)))
        << ending;
}

TEST_F(Outputs, InterruptedRunLeavesCompleteFilesAndExits130) {
  std::string text = kScenario;
  text.replace(text.find("3ms"), 3, "3000s");
  write("s.yaml", text);
  // After a second of a run that would take hours; the signal comes more than once, as from shells and `timeout`.
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
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
      EXPECT_NE(entry.path().extension(), ".part") << entry.path();
    EXPECT_FALSE(read(folder_.file("l.txt")).empty());
  }
}

}  // namespace
}  // namespace dsdpv1
