// dsdpv1-sim regress as a whole, on scenarios of a fraction of a millisecond and one of hours.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"

namespace dsdpv1 {
namespace {

namespace fs = std::filesystem;
using app_test::call;
using app_test::Called;
using testing::HasSubstr;

const char* const kGood =
    "name: small\nbaud: 12M\nend: 600us\n"
    "slaves: [{name: demo, address: 5, init: {ident: 1, max_inputs: 1, max_outputs: 1, cfg: \"30\"}}]\n"
    "expect: [{slave: demo, event: INITIALISED}]\n";

std::string with(const std::string& old, const std::string& other) {
  std::string text = kGood;
  return text.replace(text.find(old), old.size(), other);
}

class RegressCommand : public testing::Test {
 protected:
  RegressCommand() {
    fs::create_directories(folder_.path() / "scenarios");
    write("scenarios/good.yaml", kGood);
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_.file(name)) << text; }
  void write_bad() const {
    write("scenarios/bad.yaml", with("INITIALISED", "BUS_TELEGRAM_ERROR"));
    write("scenarios/wrong.yaml", with("12M", "13M"));
  }
  Called regress(const std::string& arguments) const { return call("regress " + arguments, folder_.path()); }
  std::string file(const std::string& name) const { return app_test::read(folder_.file(name)); }
  nlohmann::json runs(const std::string& arguments, int status) const {
    const Called called = regress(arguments + " --json");
    EXPECT_EQ(called.status, status) << called.err;
    const auto json = nlohmann::json::parse(called.out, nullptr, false);
    EXPECT_FALSE(json.is_discarded()) << called.err;
    return json.is_object() ? json["runs"] : nlohmann::json::array();
  }
  /// The verdict of each scenario.
  static std::map<std::string, std::string> verdicts(const nlohmann::json& runs) {
    std::map<std::string, std::string> verdicts;
    for (const auto& run : runs) verdicts[fs::path(run["scenario"].get<std::string>()).stem()] = run["verdict"];
    return verdicts;
  }
  int bash(const std::string& script) const {
    write("script.sh", "SIM='" DSDPV1_SIM "'\n" + script);
    const int status = std::system(("cd '" + folder_.path().string() + "' && bash script.sh").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// When each run was finished.
  std::map<std::string, fs::file_time_type> times() const {
    std::map<std::string, fs::file_time_type> times;
    for (const auto& entry : fs::directory_iterator(folder_.file("regression/runs")))
      if (entry.path().extension() == ".json") times[entry.path().filename()] = fs::last_write_time(entry.path());
    return times;
  }

  app_test::Folder folder_;
};

TEST_F(RegressCommand, RunsAllScenariosOfTheFolderAndSaysWhatEachHasComeTo) {
  write_bad();
  const nlohmann::json all = runs("--view pins --engine skip scenarios", 1);  // a word takes no further words
  EXPECT_EQ(verdicts(all),
            (std::map<std::string, std::string>{{"bad", "failed"}, {"good", "passed"}, {"wrong", "refused"}}));
  EXPECT_THAT(all[0]["reason"], HasSubstr("not met: demo: event BUS_TELEGRAM_ERROR at least once at the end; seen: 0"));
  EXPECT_THAT(all[2]["reason"], HasSubstr("scenarios/wrong.yaml:2: baud is \"13M\""));
}

TEST_F(RegressCommand, PassedIsExitCode0AndKeepsNoLogs) {
  EXPECT_EQ(verdicts(runs("--engine step,skip --view pins,tlm", 0)).at("good"), "passed");
  for (const auto& entry : fs::directory_iterator(folder_.file("regression/runs")))
    EXPECT_EQ(entry.path().extension(), ".json") << entry.path();
  EXPECT_EQ(times().size(), 4U);
}

TEST_F(RegressCommand, KeepsLogResultAndWaveOfWhatIsWanted) {
  write_bad();
  const nlohmann::json all = runs("--wave vcd scenarios/good.yaml scenarios/bad.yaml", 1);
  EXPECT_EQ(all[0]["files"], nlohmann::json::array());
  EXPECT_EQ(all[1]["files"], nlohmann::json({"again.sh", "result.json", "run.log", "wave.vcd"}));
  const std::string folder = "regression/" + all[1]["folder"].get<std::string>();
  EXPECT_THAT(file(folder + "/run.log"), HasSubstr("FAILED: demo: event BUS_TELEGRAM_ERROR"));
  EXPECT_THAT(file("regression/index.html"), HasSubstr("/wave.vcd\""));
  EXPECT_EQ(runs("--keep all scenarios/good.yaml", 0)[0]["files"], nlohmann::json({"result.json", "run.log"}));
}

TEST_F(RegressCommand, ReportOfEachRunThatIsKeptIsLinkedFromThePage) {
  write_bad();
  const nlohmann::json run = runs("--report scenarios/good.yaml scenarios/bad.yaml", 1)[1];
  EXPECT_EQ(run["files"], nlohmann::json({"again.sh", "report.html", "result.json", "run.log"}));
  const std::string page = run["folder"].get<std::string>() + "/report.html";
  EXPECT_THAT(file("regression/" + page), HasSubstr("event BUS_TELEGRAM_ERROR"));
  EXPECT_THAT(file("regression/index.html"), HasSubstr("<a href=\"" + page + "\">"));
  EXPECT_EQ(runs("--failed", 1)[1]["files"], run["files"]);
}

TEST_F(RegressCommand, SettingsTakeRanges) {
  const nlohmann::json all = runs("--set user_cpu.fsmc.datast=2..4 --set baud=12M,6M", 0);
  EXPECT_EQ(all.size(), 6U);
  EXPECT_EQ(all[5]["settings"], nlohmann::json({"user_cpu.fsmc.datast=4", "baud=6M"}));
}

TEST_F(RegressCommand, ARunThatHangsIsKilledAndNamed) {
  write("scenarios/long.yaml", with("600us", "3000s"));
  const nlohmann::json all = runs("scenarios/long.yaml --time-limit 0.5 --junit report.xml", 1);
  EXPECT_EQ(verdicts(all), (std::map<std::string, std::string>{{"long", "hung"}}));
  EXPECT_THAT(all[0]["reason"], HasSubstr("still ran after 0."));
  EXPECT_THAT(file("report.xml"), HasSubstr("<testcase classname=\"scenarios/long.yaml\" name=\"skip pins\""));
}

// The child is killed when its log has begun, so that it has last lines. SIGABRT, because the sanitizers handle a
// SIGSEGV themselves.
TEST_F(RegressCommand, ARunThatCrashesIsAFailureWithItsSignalAndTheEndOfItsLog) {
  write("scenarios/long.yaml", with("600us", "3000s"));
  EXPECT_EQ(bash("\"$SIM\" regress scenarios/long.yaml --json >out 2>err & regress=$!\n"
                 "until log=$(ls regression/runs/*.run/run.log.*.part 2>/dev/null) && [ -s \"$log\" ]; do\n"
                 "  kill -0 $regress || exit 98; [ $SECONDS -lt 300 ] || exit 97; done\n"
                 "child=${log%.part}; kill -ABRT ${child##*.}\nwait $regress\n"),
            1);
  const nlohmann::json run = nlohmann::json::parse(file("out"))["runs"][0];
  EXPECT_EQ(run["verdict"], "crashed");
  EXPECT_EQ(run["reason"], "killed by signal 6 (SIGABRT)");
  EXPECT_EQ(run["exit"], 134);
  EXPECT_THAT(run["log"], HasSubstr(" ns  demo "));
  EXPECT_EQ(run["files"], nlohmann::json({"again.sh", "run.log"}));
}

TEST_F(RegressCommand, InterruptedItExits130AndTheSameCommandGoesOn) {
  write("scenarios/long.yaml", with("600us", "3000s"));
  EXPECT_EQ(
      bash("\"$SIM\" regress --jobs 1 2>err & regress=$!\n"
           "until ls regression/runs/good.*.json >/dev/null 2>&1 && ls regression/runs/long.*.run >/dev/null 2>&1; do\n"
           "  kill -0 $regress || exit 98; [ $SECONDS -lt 300 ] || exit 97; done\n"
           "kill -INT $regress; wait $regress\n"),
      130);
  EXPECT_THAT(file("err"),
              HasSubstr("regression: interrupted, 1 of 2 runs are kept; the same command resumes from there\n"));
  EXPECT_FALSE(fs::exists(folder_.file("regression/index.html")));
  const auto before = times();
  EXPECT_EQ(before.size(), 1U);
  write("scenarios/long.yaml", kGood);
  const Called called = regress("");
  EXPECT_EQ(called.status, 0) << called.err;
  EXPECT_THAT(called.err, HasSubstr("regression: 1 of 2 runs are there already\n"));
  EXPECT_EQ(times()[before.begin()->first], before.begin()->second);
}

TEST_F(RegressCommand, OnlyWhatHasChangedIsRunAgain) {
  write("scenarios/other.yaml", kGood);
  ASSERT_EQ(regress("").status, 0);
  auto before = times();
  write("scenarios/other.yaml", with("600us", "700us"));
  EXPECT_THAT(regress("").err, HasSubstr("1 of 2 runs are there already"));
  auto after = times();
  for (const auto& [name, time] : before) EXPECT_EQ(after[name] == time, name.rfind("good", 0) == 0) << name;
}

TEST_F(RegressCommand, FailedRunsAgainWhatHasNotPassed) {
  write_bad();
  ASSERT_EQ(regress("").status, 1);
  auto before = times();
  write("scenarios/bad.yaml", kGood);
  write("scenarios/good.yaml", with("INITIALISED", "BUS_TELEGRAM_ERROR"));  // has passed and is not checked
  const Called called = regress("--failed --json");
  EXPECT_EQ(called.status, 1);
  EXPECT_THAT(called.err, HasSubstr("1 of 3 runs are there already"));
  EXPECT_EQ(verdicts(nlohmann::json::parse(called.out)["runs"]),
            (std::map<std::string, std::string>{{"bad", "passed"}, {"good", "passed"}, {"wrong", "refused"}}));
  auto after = times();
  for (const auto& [name, time] : before) EXPECT_EQ(after[name] == time, name.rfind("good", 0) == 0) << name;
  write("scenarios/wrong.yaml", kGood);
  EXPECT_EQ(regress("--failed").status, 0);
}

TEST_F(RegressCommand, ShardsOfOneFolderMakeUpAllOfIt) {
  std::size_t count = 0;
  for (const char* shard : {"1/3", "2/3", "3/3"}) {
    const Called called = regress(std::string("--set user_cpu.fsmc.datast=2..9 --json --shard ") + shard);
    EXPECT_EQ(called.status, 0) << called.err;
    count += nlohmann::json::parse(called.out)["runs"].size();
  }
  EXPECT_EQ(count, 8U);
  EXPECT_THAT(regress("--set user_cpu.fsmc.datast=2..9").err, HasSubstr("8 of 8 runs are there already"));
}

TEST_F(RegressCommand, JunitIsValid) {
  write_bad();
  EXPECT_EQ(regress("--junit report.xml").status, 1);
  EXPECT_EQ(
      std::system((XMLLINT " --noout --schema " JUNIT_XSD " '" + folder_.file("report.xml") + "' 2>/dev/null").c_str()),
      0);
}

TEST_F(RegressCommand, ItsFilesReplaceNoScenario) {
  ASSERT_EQ(regress("").status, 0);
  const Called called = regress("--junit scenarios/good.yaml");
  EXPECT_EQ(called.status, 2);
  EXPECT_THAT(called.err, HasSubstr("--junit would replace a file of a scenario"));
  EXPECT_EQ(file("scenarios/good.yaml"), kGood);
}

}  // namespace
}  // namespace dsdpv1
