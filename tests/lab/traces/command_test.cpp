// traces: check, regenerate, list and wave on a short scenario in a separate folder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "lab/traces/golden.hpp"
#include "lab/traces/xz.hpp"
#include "tests/app/program.hpp"

namespace dsdpv1 {
namespace {

namespace fs = std::filesystem;
using app_test::call;
using app_test::Called;
using app_test::read;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;

constexpr const char* kSource = DSDPV1_SOURCE_DIR;
const std::string kName = "bus_timing";  // 5 ms

void write(const fs::path& path, const std::string& text) {
  fs::remove(path);
  std::ofstream(path, std::ios::binary) << text;
}

class TracesCommand : public testing::Test {
 protected:
  TracesCommand() {
    fs::create_directories(folder_.path() / "scenarios");
    for (const std::string& file : {kName + ".yaml", std::string("dsdpv1.gsd")})
      fs::copy(fs::path(kSource) / "scenarios" / file, folder_.path() / "scenarios" / file);
    fs::create_directories(folder_.path() / "traces");
    for (const std::string& file : {kName + ".json", kName + ".trace.xz"})
      fs::copy(fs::path(kSource) / "traces" / file, folder_.path() / "traces" / file);
  }
  Called traces(const std::string& action, const std::string& options = "") const {
    const std::string scenario = action == "list" ? "" : " scenarios/" + kName + ".yaml";
    return call("traces " + action + scenario + " --folder traces " + options, folder_.path());
  }
  fs::path scenario() const { return folder_.path() / "scenarios" / (kName + ".yaml"); }
  fs::path gsd() const { return folder_.path() / "scenarios/dsdpv1.gsd"; }
  fs::path manifest() const { return folder_.path() / "traces" / (kName + ".json"); }
  fs::path trace() const { return folder_.path() / "traces" / (kName + ".trace.xz"); }

  /// The check ends with exit code 2 and this one line.
  void expect_refused(const std::string& words) const {
    const Called called = traces("check");
    EXPECT_EQ(called.status, 2);
    EXPECT_THAT(called.out, IsEmpty());
    EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
    EXPECT_THAT(called.err, HasSubstr(words));
    EXPECT_THAT(called.err, HasSubstr(", expected what ./run traces regenerate bus_timing writes"));
  }
  /// Another trace with a manifest that fits it.
  void replace_trace(const std::string& content) const {
    const tb::traces::Trace replaced(content, "replaced");
    auto json = tb::traces::Json::parse(read(manifest()));
    json.update(tb::traces::contents_of(replaced));
    write(manifest(), tb::traces::text_of(json));
    write(trace(), tb::traces::compress(content));
  }
  std::string trace_content() const { return tb::traces::decompress(read(trace()), tb::traces::kMostBytes).content; }
  /// Changes the golden to one whose first fall of INTR0 is a cycle later: its second entry moves by 250 ticks.
  void shift_interrupt() const;

  app_test::Folder folder_;
};

TEST_F(TracesCommand, CheckFindsNoDifferenceInStepAndSkip) {
  for (const char* engine : {"step", "skip"}) {
    const Called called = traces("check", std::string("--engine ") + engine);
    EXPECT_EQ(called.status, 0) << called.err;
    EXPECT_THAT(called.out, MatchesRegex("golden +bus_timing: [0-9]+ changes are the same\n"));
  }
}

TEST_F(TracesCommand, ANameMeansTheScenarioOfTheSourceTree) {
  EXPECT_EQ(call("traces check " + kName, folder_.path()).status, 0);
  const Called called = call("traces check bus_timings", folder_.path());
  EXPECT_EQ(called.status, 2);
  EXPECT_THAT(called.err,
              HasSubstr("there is no scenario bus_timings (did you mean bus_timing?), expected a path and the names "));
}

TEST_F(TracesCommand, AChangedScenarioIsRefused) {
  write(scenario(), read(scenario()) + "\n");
  expect_refused(
      "scenarios/bus_timing.yaml: is not what traces/bus_timing.json was made from, scenario: bus_timing.yaml is ");
}

TEST_F(TracesCommand, AChangedGsdIsRefused) {
  write(gsd(), read(gsd()) + "\n");
  expect_refused("is not what traces/bus_timing.json was made from, files: dsdpv1.gsd is ");
}

TEST_F(TracesCommand, AnotherParameterIsRefused) {
  auto json = tb::traces::Json::parse(read(manifest()));
  json["parameters"]["access_interval"] = "49";
  write(manifest(), json.dump());
  expect_refused(R"(parameters: access_interval is "49" there and "48" now)");
}

TEST_F(TracesCommand, AManifestThatIsNoneIsRefused) {
  for (const char* text : {"", "[]", "{", "\xFF\xFE", R"({"format": "x)"}) {
    write(manifest(), text);
    expect_refused("traces/bus_timing.json: is no manifest of a golden trace");
  }
  for (const char* text : {"{}", R"({"format": 2})", R"({"format": {"a": 1}})"}) {
    write(manifest(), text);
    expect_refused("traces/bus_timing.json: is of another format, format ");
  }
}

TEST_F(TracesCommand, AManifestWithOtherCountsIsRefused) {
  auto json = tb::traces::Json::parse(read(manifest()));
  json["slaves"]["demo"]["pins"]["INTR0"] = 5;
  write(manifest(), json.dump());
  expect_refused(
      "traces/bus_timing.trace.xz: is not the trace of traces/bus_timing.json, slaves: demo: pins: INTR0 is 5");
}

TEST_F(TracesCommand, ATruncatedDamagedOrForeignTraceIsRefused) {
  const std::string right = read(trace());
  write(trace(), right.substr(0, right.size() / 2));
  expect_refused("traces/bus_timing.trace.xz: is truncated");
  std::string damaged = right;
  damaged[right.size() / 2] = static_cast<char>(damaged[right.size() / 2] ^ 0x10);
  write(trace(), damaged);
  expect_refused("traces/bus_timing.trace.xz: is damaged");
  write(trace(), "");
  expect_refused("traces/bus_timing.trace.xz: is truncated");
  write(trace(), read(gsd()));
  expect_refused("traces/bus_timing.trace.xz: is no .xz file");
  write(trace(), read(fs::path(kSource) / "traces/watchdog.trace.xz"));
  expect_refused("traces/bus_timing.trace.xz: is not the trace of traces/bus_timing.json, trace: sha256 is ");
}

TEST_F(TracesCommand, ATraceThatHoldsSomethingElseIsRefused) {
  write(trace(), tb::traces::compress("hello"));
  const Called called = traces("check");
  EXPECT_EQ(called.status, 2);
  EXPECT_EQ(called.err,
            "traces/bus_timing.trace.xz: holds no trace, expected what begins with \"golden trace 1\" "
            "(docs/traces.md)\n");
}

TEST_F(TracesCommand, AScenarioWithoutGoldenIsRefused) {
  fs::remove(manifest());
  expect_refused("traces/bus_timing.json: no such file, bus_timing has no golden");
  fs::copy(fs::path(kSource) / "traces/bus_timing.json", manifest());
  fs::remove(trace());
  const Called called = traces("check");
  EXPECT_EQ(called.status, 2);
  EXPECT_EQ(called.err, "traces/bus_timing.trace.xz: no such file, expected a golden trace (.xz)\n");
}

TEST_F(TracesCommand, AGoldenWithoutScenarioIsNamedWhenAllAreChecked) {
  for (const char* ending : {".json", ".trace.xz"}) {
    fs::rename(folder_.path() / "traces" / (kName + ending),
               folder_.path() / "traces" / (std::string("gone") + ending));
  }
  const Called called = call("traces check --folder traces", folder_.path());  // none is run: none has a golden
  EXPECT_EQ(called.status, 2);
  EXPECT_THAT(called.err, HasSubstr("traces/gone.json: there is no scenario "));
  for (const std::string& name : app_test::shipped_scenarios())
    EXPECT_THAT(called.err, HasSubstr("traces/" + name + ".json: no such file, " + name + " has no golden, expected"));
}

void TracesCommand::shift_interrupt() const {
  const tb::traces::Trace before(trace_content(), "before");
  tb::traces::TraceWriter writer(before.signals());
  for (std::size_t i = 0; i < before.signals().size(); ++i) {
    tb::traces::Cursor each = before.cursor(i);
    for (int entry = 0; each.at() != bus::kNever; each.step(), ++entry)
      writer.change(i, each.at() + (before.signals()[i].name == "INTR0" && entry == 1 ? 250 : 0), each.level());
  }
  replace_trace(writer.content(before.end()));
}

TEST_F(TracesCommand, ADifferenceIsNamedInWordsAndExitIs1) {
  shift_interrupt();
  const Called called = traces("check");
  EXPECT_EQ(called.status, 1) << called.err;
  EXPECT_THAT(called.out, MatchesRegex("golden +bus_timing: [0-9]+ changes are the same, then it differs\n"
                                       "first difference  cycle [0-9]+ \\([0-9.]+ us\\)\n"
                                       " +pin INTR0 of demo: golden still 1, here 0\n"
                                       "on the bus        .*SC \\(short acknowledge\\).*\n"
                                       "last access       read B[0-9A-F]+ at cycle .*\n"));
}

TEST_F(TracesCommand, RegenerateSaysWhatChangedAndMakesTheGoldenOfTheSourceTree) {
  const std::string shipped_trace = read(trace());
  shift_interrupt();
  const Called called = traces("regenerate");
  EXPECT_EQ(called.status, 0) << called.err;
  EXPECT_THAT(called.out, MatchesRegex("bus_timing: other, ([0-9]+) changes before, [0-9]+ now\n"
                                       "first difference  cycle [0-9]+ \\([0-9.]+ us\\)\n"
                                       " +pin INTR0 of demo: golden still 1, here 0\n(.|\n)*"));
  EXPECT_EQ(traces("check").status, 0);
  EXPECT_TRUE(trace_content() == tb::traces::decompress(shipped_trace, tb::traces::kMostBytes).content);
}

TEST_F(TracesCommand, RegenerateLeavesWhatIsTheSameUntouched) {
  const auto old = fs::file_time_type::clock::now() - std::chrono::hours(1);
  write(trace(), tb::traces::compress(trace_content()));  // whatever the version of liblzma
  fs::last_write_time(trace(), old);
  const Called first = traces("regenerate");  // the rulings may have changed since it was made
  EXPECT_EQ(first.status, 0) << first.err;
  fs::last_write_time(manifest(), old);
  const Called called = traces("regenerate");
  EXPECT_EQ(called.status, 0) << called.err;
  EXPECT_THAT(called.out, MatchesRegex("bus_timing: the same, [0-9]+ changes\n"));
  EXPECT_EQ(fs::last_write_time(trace()), old);
  EXPECT_EQ(fs::last_write_time(manifest()), old);
}

TEST_F(TracesCommand, RegenerateMakesWhatIsMissingOrDamaged) {
  fs::remove(manifest());
  write(trace(), "damaged");
  const Called called = traces("regenerate");
  EXPECT_EQ(called.status, 0) << called.err;
  EXPECT_THAT(called.out, MatchesRegex("bus_timing: new, [0-9]+ changes\n"));
  EXPECT_EQ(traces("check").status, 0);
}

TEST_F(TracesCommand, RegenerateKeepsTheGoldenOfAScenarioThatDoesNotPass) {
  std::string text = read(scenario());
  const std::size_t expect = text.rfind("dp_state: data_exch");
  ASSERT_NE(expect, std::string::npos);
  write(scenario(), text.replace(expect, 19, "dp_state: wait_cfg"));
  const std::string before = read(manifest());
  const Called called = traces("regenerate");
  EXPECT_EQ(called.status, 1);
  EXPECT_EQ(called.out, "bus_timing: does not pass, its golden stays as it is\n");
  EXPECT_EQ(read(manifest()), before);
}

TEST_F(TracesCommand, ListNamesTheGoldens) {
  const Called called = traces("list");
  EXPECT_EQ(called.status, 0) << called.err;
  EXPECT_THAT(called.out, MatchesRegex("(.|\n)*bus_timing +1 +240000 +[0-9]+ +[0-9.]+ +(as they are|of before)\n"));
  EXPECT_EQ(call("traces list --folder nowhere", folder_.path()).status, 2);
}

TEST_F(TracesCommand, WaveHoldsThePinsOfARunsWave) {
  for (const char* file : {"golden.vcd", "golden.fst"}) {
    const Called called = call("traces wave " + kName + " " + file + " --folder traces", folder_.path());
    ASSERT_EQ(called.status, 0) << called.err;
    EXPECT_GT(fs::file_size(folder_.path() / file), 1000U);
  }
  ASSERT_EQ(call("run scenarios/bus_timing.yaml -q --wave run.vcd", folder_.path()).status, 0);
  const auto times = [this](const std::string& file, const std::string& name) {
    const std::string text = read(folder_.path() / file);
    const std::size_t at = text.find(" " + name + " $end");
    const std::string id = text.substr(text.rfind(' ', at - 1) + 1, at - text.rfind(' ', at - 1) - 1);
    std::istringstream lines(text.substr(text.find("$enddefinitions")));
    std::vector<std::string> changes;
    for (std::string line, time; std::getline(lines, line);) {
      if (line[0] == '#') time = line;
      if (line == "0" + id || line == "1" + id) changes.push_back(time + " " + line[0]);
    }
    return changes;
  };
  for (const char* name : {"line", "L_REQ", "RD", "PBTXD", "INTR0"}) {
    EXPECT_GT(times("run.vcd", name).size(), 2U) << name;
    EXPECT_EQ(times("golden.vcd", name), times("run.vcd", name)) << name;
  }
  EXPECT_EQ(call("traces wave " + kName + " golden.txt --folder traces", folder_.path()).status, 2);
  EXPECT_EQ(call("traces wave nothing golden.vcd --folder traces", folder_.path()).status, 2);
}

TEST_F(TracesCommand, OptionsThatDoNotFitAreRefused) {
  const std::string run = "run scenarios/bus_timing.yaml --golden traces ";
  for (const char* options : {"--view tlm", "--set end=1ms"}) {
    const Called called = call(run + options, folder_.path());
    EXPECT_EQ(called.status, 2) << options;
    EXPECT_THAT(called.err, MatchesRegex("dsdpv1-sim run: --golden is about .*, it (needs|excludes) .*\n"));
  }
  const Called fault = traces("check", "--fault 3");
  EXPECT_EQ(fault.status, 2);
  EXPECT_THAT(fault.err, HasSubstr("--fault is one of the RTL, it needs --engine rtl or lockstep"));
  EXPECT_EQ(traces("check", "--engine fast").status, 2);
  for (const char* none : {"", " chek", " --help-me"})
    EXPECT_EQ(call(std::string("traces") + none, folder_.path()).status, 2);
  EXPECT_THAT(call("traces", folder_.path()).err, HasSubstr("expected check, regenerate, list, wave"));
  EXPECT_THAT(call("traces regenerate --folder nowhere", folder_.path()).err,
              HasSubstr("nowhere: is no folder of golden traces, expected one like traces"));
}

}  // namespace
}  // namespace dsdpv1
