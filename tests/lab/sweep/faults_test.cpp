// Sweeps with several runs at a time: one is killed, two share a folder, one ignores a signal. Their final result
// equals that of an undisturbed sweep. tests/faults covers the other faults.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "tests/app/program.hpp"

namespace dsdpv1 {
namespace {

namespace fs = std::filesystem;
using app_test::call;
using app_test::Called;
using testing::MatchesRegex;

const char* const kScenario =
    "name: small\nbaud: 12M\nend: 600us\n"
    "slaves: [{name: demo, address: 5, gsd: a.gsd, modules: [1 byte in],\n"
    "          init: {ident: 1, max_inputs: 1, max_outputs: 1, cfg: \"30\"}}]\n"
    "expect: [{slave: demo, event: INITIALISED}]\n";

// The first point is short, the second takes hours: actions after the first happen while the sweep runs.
const char* const kLong = "--param end=600us,3000s --jobs 1 --out out";
const char* const kShort = "--param user_cpu.cycle=50us,60us,70us --param end=600us,20ms --out out";

// start ARGUMENTS: a separate sweep that has finished its first point. child: waits until a run exists.
// finish: waits for the sweep's end.
const char* const kWords =
    "start() {\n"
    "  mkfifo bar; \"$SIM\" sweep s.yaml \"$@\" --progress 2>bar & sweep=$!\n"
    "  exec 3<bar; bar=; until [[ $bar == *'#'* ]]; do read -r -d ']' bar <&3 || exit 99; done\n"
    "}\n"
    "child() {\n"
    "  child=; until [ -n \"$child\" ]; do\n"
    "    kill -0 $sweep || exit 98; read -r child _ <\"/proc/$sweep/task/$sweep/children\"; done\n"
    "}\n"
    "finish() { cat <&3 >err; wait $sweep; }\n";

class SweepFault : public testing::Test {
 protected:
  SweepFault() {
    write("s.yaml", kScenario);
    fs::copy_file(DSDPV1_SOURCE_DIR "/scenarios/dsdpv1.gsd", folder_.file("a.gsd"));
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_.file(name)) << text; }
  Called sweep(const std::string& arguments) const { return call("sweep s.yaml " + arguments, folder_.path()); }
  std::string file(const std::string& name) const { return app_test::read(folder_.file(name)); }
  /// Runs a bash script with the words above in the folder; returns its exit code.
  int bash(const std::string& script) const {
    write("script.sh", "SIM='" DSDPV1_SIM "'\n" + (kWords + script));
    const int status = std::system(("cd '" + folder_.path().string() + "' && bash script.sh").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// Resumes the sweep and compares its result with that of one in a new folder.
  void expect_same_as_undisturbed(const std::string& arguments) const {
    const Called called = sweep(arguments);
    ASSERT_EQ(called.status, 0) << called.err;
    ASSERT_EQ(sweep(arguments + "_whole").status, 0);
    EXPECT_NE(file("out/results.csv"), "");
    EXPECT_EQ(file("out/results.csv"), file("out_whole/results.csv"));
    EXPECT_EQ(file("out/map.svg"), file("out_whole/map.svg"));
    EXPECT_EQ(names("out"), names("out_whole"));
  }
  std::vector<std::string> names(const std::string& folder) const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.file(folder)))
      names.push_back(fs::relative(entry.path(), folder_.file(folder)));
    std::sort(names.begin(), names.end());
    return names;
  }

  app_test::Folder folder_;
};

// nohup: the runs ignore the signals that the sweep ignores. SIGHUP is the first bit.
TEST_F(SweepFault, RunsIgnoreAHangUpThatTheSweepIgnores) {
  EXPECT_EQ(bash(std::string("trap '' HUP; start ") + kLong +
                 "\nchild; until tr '\\0' ' ' <\"/proc/$child/cmdline\" | grep -q '^dsdpv1-sim run '; do\n"
                 "  [ $SECONDS -lt 300 ] || exit 97; done\n"
                 "grep '^SigIgn:' /proc/$child/status >ignored; kill -TERM $sweep; finish\n"),
            130);
  EXPECT_THAT(file("ignored"), MatchesRegex("SigIgn:.*[13579bdf]\n"));
}

TEST_F(SweepFault, KilledOneGoesOnToTheSameResults) {
  // Long enough that the signal comes before the end on a busy machine too.
  const std::string jobs = "--jobs 2 --param user_cpu.cycle=50us,60us,70us --param end=600us,300ms --out out";
  ASSERT_EQ(bash("start " + jobs +
                 "\nkill -KILL $sweep; finish; killed=$?\necho half >out/points/00005.7.run.part; exit $killed\n"),
            137);
  EXPECT_FALSE(fs::exists(folder_.file("out/results.csv")));
  expect_same_as_undisturbed(jobs);
}

TEST_F(SweepFault, TwoThatBeginAtOnceGiveOneRightResult) {
  const std::string one = std::string("$SIM sweep s.yaml --quiet ") + kShort + " 2>/dev/null & ";
  ASSERT_EQ(bash(one + "a=$!; " + one + "b=$!; wait $a; a=$?; wait $b; echo \"$a$?\" >status\n"), 0);
  EXPECT_THAT(file("status"), MatchesRegex("(00|02|20)\n"));
  EXPECT_NE(file("out/results.csv"), "");
  expect_same_as_undisturbed(kShort);
}

}  // namespace
}  // namespace dsdpv1
