// What a sweep keeps when it is killed, disturbed, or not alone. What it gives in the end is the same as that of a
// sweep that was let alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "tests/app/program.hpp"

namespace {

namespace fs = std::filesystem;
using app_test::call;
using app_test::Called;
using testing::HasSubstr;
using testing::MatchesRegex;

const char* const kScenario =
    "name: small\nbaud: 12M\nend: 600us\n"
    "slaves: [{name: demo, address: 5, gsd: a.gsd, modules: [1 byte in],\n"
    "          init: {ident: 1, max_inputs: 1, max_outputs: 1, cfg: \"30\"}}]\n"
    "expect: [{slave: demo, event: INITIALISED}]\n";

// A first point that is short and one that takes hours: what is done after the first is done while the sweep runs.
const char* const kLong = "--param end=600us,3000s --jobs 1 --out out";
const char* const kShort = "--param user_cpu.cycle=50us,60us,70us --param end=600us,20ms --out out";

// start ARGUMENTS: a sweep of its own, which has finished its first point then. child [PID]: waits until a run is there
// that is not PID. gone PID: waits until it lives no more, and fails when it does not die. finish: waits for the
// sweep's end.
const char* const kWords =
    "start() {\n"
    "  mkfifo bar; \"$SIM\" sweep s.yaml \"$@\" --progress 2>bar & sweep=$!\n"
    "  exec 3<bar; bar=; until [[ $bar == *'#'* ]]; do read -r -d ']' bar <&3 || exit 99; done\n"
    "}\n"
    "child() {\n"
    "  child=$1; until [ -n \"$child\" ] && [ \"$child\" != \"$1\" ]; do\n"
    "    kill -0 $sweep || exit 98; read -r child _ <\"/proc/$sweep/task/$sweep/children\"; done\n"
    "}\n"
    "gone() {\n"
    "  until ! [ -e /proc/$1 ] || grep -q '^State:.Z' /proc/$1/status; do\n"
    "    [ $SECONDS -lt 300 ] || { kill -KILL $1; exit 97; }; done 2>/dev/null\n"
    "}\n"
    "finish() { cat <&3 >err; wait $sweep; }\n";

class SweepFault : public testing::Test {
 protected:
  SweepFault() {
    write("s.yaml", kScenario);
    fs::copy_file(DSDPV1_SOURCE_DIR "/scenarios/dsdpv1.gsd", folder_.file("a.gsd"));
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_.file(name)) << text; }
  void append(const std::string& name) const { std::ofstream(folder_.file(name), std::ios::app) << "\n; more\n"; }
  Called sweep(const std::string& arguments) const { return call("sweep s.yaml " + arguments, folder_.path()); }
  std::string file(const std::string& name) const { return app_test::read(folder_.file(name)); }
  /// Runs a script of bash with the words above in the folder; its exit code.
  int bash(const std::string& script) const {
    write("script.sh", "SIM='" DSDPV1_SIM "'\n" + (kWords + script));
    const int status = std::system(("cd '" + folder_.path().string() + "' && bash script.sh").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// Goes on with the sweep and holds what it gives against that of one in a new folder.
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

TEST_F(SweepFault, RunsEndWithASweepThatIsKilled) {
  EXPECT_EQ(bash(std::string("start ") + kLong + "\nchild; kill -KILL $sweep; gone $child\n"), 0);
}

// nohup: what the sweep ignores, its runs do, too. SIGHUP is the first bit.
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

TEST_F(SweepFault, SecondOneInItsFolderSaysWhoHasIt) {
  EXPECT_EQ(bash(std::string("start ") + kLong +
                 "\ntimeout 300 $SIM sweep s.yaml --param end=600us,3000s --out out 2>second; echo $? >status\n"
                 "echo \"out: a sweep with process id $sweep is using it, allowed is one sweep at a time\" >expected\n"
                 "kill -TERM $sweep; finish\n"),
            130);
  EXPECT_EQ(file("status"), "2\n");
  EXPECT_EQ(file("second"), file("expected"));
  EXPECT_THAT(file("err"), HasSubstr("sweep: interrupted, 1 of 2 points are kept"));
}

TEST_F(SweepFault, TwoThatBeginAtOnceGiveOneRightResult) {
  const std::string one = std::string("$SIM sweep s.yaml --quiet ") + kShort + " 2>/dev/null & ";
  ASSERT_EQ(bash(one + "a=$!; " + one + "b=$!; wait $a; a=$?; wait $b; echo \"$a$?\" >status\n"), 0);
  EXPECT_THAT(file("status"), MatchesRegex("(00|02|20)\n"));
  EXPECT_NE(file("out/results.csv"), "");
  expect_same_as_undisturbed(kShort);
}

// The result of a run, which is indented, does not fit; the same in the sweep's own form, without spaces, would.
TEST_F(SweepFault, FullDiskIsNotTakenForAPointThatIsNotPossible) {
  const std::string arguments = "--param user_cpu.cycle=50us,60us --jobs 1 --out out";
  ASSERT_EQ(sweep(arguments + "_size").status, 0);
  const std::string blocks = std::to_string(fs::file_size(folder_.file("out_size/points/00000.json")) / 1024 + 2);
  ASSERT_EQ(bash("trap '' XFSZ; ulimit -f " + blocks + "; $SIM sweep s.yaml " + arguments + " 2>err\n"), 2);
  EXPECT_THAT(file("err"), HasSubstr("dsdpv1-sim sweep: point 0 (cycle=50us) cannot be run: out/points/00000."));
  EXPECT_THAT(file("err"), HasSubstr("cannot be written: File too large; 0 of 2 points are kept\n"));
  expect_same_as_undisturbed(arguments);
}

TEST_F(SweepFault, RunThatIsKilledOnceGetsAnotherTry) {
  EXPECT_EQ(bash("start --param end=600us,1s --jobs 1 --out out >/dev/null\nchild; kill -KILL $child; finish\n"), 0)
      << file("err");
  EXPECT_THAT(file("out/results.csv"), HasSubstr("\n1,1s,yes,0,"));
}

TEST_F(SweepFault, RunThatIsKilledTwiceEndsTheSweepWithItsPoint) {
  EXPECT_EQ(
      bash(std::string("start ") + kLong + "\nchild; kill -KILL $child; child $child; kill -KILL $child; finish\n"), 2);
  EXPECT_THAT(file("err"), HasSubstr("dsdpv1-sim sweep: point 1 (end=3000s) cannot be run: its run was killed by "
                                     "signal 9; 1 of 2 points are kept\n"));
  EXPECT_EQ(names("out"), (std::vector<std::string>{"points", "points/00000.json", "sweep.json"}));
}

// The run that is killed is tried again, and finds the other content.
TEST_F(SweepFault, InputThatChangesMeanwhileEndsIt) {
  EXPECT_EQ(bash(std::string("start ") + kLong + "\nchild; echo '; more' >>a.gsd; kill -KILL $child; finish\n"), 2);
  EXPECT_THAT(file("err"),
              HasSubstr("a.gsd: was changed while the sweep ran, allowed is the same content for all of its points\n"));
  EXPECT_FALSE(fs::exists(folder_.file("out/results.csv")));
  EXPECT_THAT(sweep("--param end=600us --out out").err, HasSubstr("its points are removed, the sweep starts again\n"));
}

// Held still, the run has read its files already or not; the change is seen at its end in either case.
TEST_F(SweepFault, PointWhoseInputChangedUnderItIsNotKept) {
  EXPECT_EQ(bash("start --param end=600us,1s,2s --jobs 1 --out out\n"
                 "child; kill -STOP $child; echo '; more' >>a.gsd; kill -CONT $child; finish\n"),
            2);
  EXPECT_THAT(file("err"), HasSubstr("a.gsd: was changed while the sweep ran"));
  EXPECT_THAT(names("out"), testing::Contains("points/00000.json"));
  EXPECT_THAT(names("out"), testing::Not(testing::Contains("points/00002.json")));
}

// With the same content: what the run has read in between is not known.
TEST_F(SweepFault, PointWhoseInputWasWrittenUnderItIsTriedOnceMore) {
  const std::string touch = "kill -STOP $child; touch a.gsd; kill -CONT $child; ";
  EXPECT_EQ(
      bash("start --param end=600us,500ms --jobs 1 --out out\nchild; " + touch + "child $child; " + touch + "finish\n"),
      2);
  EXPECT_THAT(file("err"),
              HasSubstr("point 1 (end=500ms) cannot be run: one of its files was written while it ran; 1 of 2"));
}

TEST_F(SweepFault, AnotherGsdFileIsNotAnsweredFromTheFolder) {
  const std::string arguments = "--param user_cpu.cycle=50us,60us --out out";
  ASSERT_EQ(sweep(arguments).status, 0);
  append("a.gsd");
  const Called called = sweep(arguments);
  EXPECT_EQ(called.err,
            "sweep: out is about another scenario or other content of its files: its points are removed, the sweep "
            "starts again\n");
  expect_same_as_undisturbed(arguments);
}

TEST_F(SweepFault, AnotherProgramIsNotAnsweredFromTheFolder) {
  const std::string arguments = " sweep s.yaml --quiet --param user_cpu.cycle=50us,60us --out out 2>err; ";
  EXPECT_EQ(bash("cp $SIM sim; ./sim" + arguments + "echo >>sim; ./sim" + arguments), 0);
  EXPECT_EQ(file("err"),
            "sweep: out is about another version of the program: its points are removed, the sweep starts again\n");
}

// Whatever the sweep would write or remove in its folder can be an input, or lead to one.
TEST_F(SweepFault, InputInItsFolderIsNeitherReplacedNorRemoved) {
  const std::string arguments = "--param user_cpu.cycle=50us,60us --out out";
  ASSERT_EQ(sweep(arguments).status, 0);
  const std::string gsd = file("a.gsd");
  for (const char* link : {"out/map.svg", "out/points/00000.json", "out/results.csv"}) {
    fs::remove(folder_.file(link));
    fs::create_symlink(folder_.file("a.gsd"), folder_.file(link));
    EXPECT_THAT(sweep(arguments).err, HasSubstr(" of --out would replace a file of the scenario, out/")) << link;
    EXPECT_THAT(sweep("--param gsd=a.gsd --out out").err, HasSubstr(" of --out would replace a file of the ")) << link;
    EXPECT_TRUE(file("a.gsd") == gsd) << link;
    fs::remove(folder_.file(link));
  }
  for (const char* own : {"out/map_2.svg", "out/points/s.yaml"}) {  // a sweep that starts again removes them
    write(own, kScenario);
    EXPECT_THAT(call(std::string("sweep ") + own + " " + arguments, folder_.path()).err, HasSubstr("would replace"));
    EXPECT_EQ(file(own), kScenario);
    fs::remove(folder_.file(own));
  }
}

TEST_F(SweepFault, DamagedPointsAreDoneAgain) {
  ASSERT_EQ(sweep(kShort).status, 0);
  const auto damage = [this](const char* number, const std::string& text) {
    write(std::string("out/points/0000") + number + ".json", text);
  };
  const std::string first = file("out/points/00000.json"), second = file("out/points/00001.json");
  damage("0", second);
  damage("1", first);
  damage("2", file("out/points/00002.json").substr(0, 500));
  damage("3", R"({"exit": 0})");
  damage("4", R"({"settings": [], "exit": "0", "error": 7, "result": {"violations": []}})");
  EXPECT_THAT(sweep(kShort).err, HasSubstr("sweep: 1 of 6 points are there already\n"));
  expect_same_as_undisturbed(kShort);
}

}  // namespace
