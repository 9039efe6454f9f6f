// dsdpv1-sim sweep as a whole, on a scenario of a fraction of a millisecond.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>

#include "tests/app/program.hpp"

namespace dsdpv1 {
namespace {

namespace fs = std::filesystem;
using app_test::call;
using app_test::Called;
using testing::HasSubstr;

// Up to the initialisation, which already performs all accesses that a wrong bus timing can spoil.
const char* const kScenario =
    "name: small\nbaud: 12M\nend: 600us\n"
    "slaves: [{name: demo, address: 5, init: {ident: 1, max_inputs: 1, max_outputs: 1, cfg: \"30\"}}]\n"
    "expect: [{slave: demo, event: INITIALISED}]\n";

class SweepCommand : public testing::Test {
 protected:
  SweepCommand() { write("s.yaml", kScenario); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_.file(name)) << text; }
  Called sweep(const std::string& arguments) const { return call("sweep s.yaml " + arguments, folder_.path()); }
  std::string file(const std::string& name) const { return app_test::read(folder_.file(name)); }

  app_test::Folder folder_;
};

TEST_F(SweepCommand, FindsWhereTheBusTimingOfAnFsmcBegins) {
  const Called called =
      sweep("--set user_cpu.fsmc.mode=A --param user_cpu.fsmc.datast=0..3 --param user_cpu.fsmc.addset=0,1 --out out");
  EXPECT_EQ(called.status, 0) << called.err;
  EXPECT_THAT(called.out, HasSubstr("       0  2, 3                   0, 1"));
  EXPECT_THAT(called.out, HasSubstr("the timing holds at 4 of 8 points\n"));
  EXPECT_THAT(file("out/results.csv"), HasSubstr("\n0,0,0,no,1,"));
  EXPECT_THAT(file("out/results.csv"), HasSubstr("\n7,3,1,yes,0,0,0,"));
  EXPECT_THAT(file("out/map.svg"), HasSubstr("</svg>"));
}

TEST_F(SweepCommand, SameCommandAgainRunsNothingAndGivesTheSameFiles) {
  const std::string arguments = "--param user_cpu.cycle=50us,60us --jobs 2 --out out";
  ASSERT_EQ(sweep(arguments).status, 0);
  const std::string before = file("out/results.csv");
  const auto time = fs::last_write_time(folder_.file("out/points/00000.json"));
  const Called again = sweep(arguments);
  EXPECT_EQ(again.status, 0);
  EXPECT_THAT(again.err, HasSubstr("sweep: 2 of 2 points are there already\n"));
  EXPECT_EQ(fs::last_write_time(folder_.file("out/points/00000.json")), time);
  EXPECT_EQ(file("out/results.csv"), before);
}

// The child may receive the signal before or after it installs its handler: it ends with 130 in either case.
TEST_F(SweepCommand, AChildThatIsInterruptedAloneGetsAnotherTry) {
  std::string longer = kScenario;
  longer.replace(longer.find("600us"), 5, "200ms");
  write("s.yaml", longer);
  const Called called = sweep(
      "--param user_cpu.cycle=50us --out out >/dev/null 2>&1 & sweep=$!; "
      "until child=$(cat /proc/$sweep/task/$sweep/children) && [ -n \"$child\" ]; do kill -0 $sweep || exit 9; done; "
      "kill -INT $child; wait $sweep");
  EXPECT_EQ(called.status, 0) << called.err;
  EXPECT_THAT(file("out/results.csv"), HasSubstr("\n0,50us,yes,0,"));
}

TEST_F(SweepCommand, GoesOnWithTheMissingPoints) {
  const std::string arguments = "--param user_cpu.cycle=50us,60us --out out";
  ASSERT_EQ(sweep(arguments).status, 0);
  const std::string before = file("out/results.csv");
  fs::remove(folder_.file("out/points/00001.json"));
  fs::remove(folder_.file("out/results.csv"));
  EXPECT_THAT(sweep(arguments).err, HasSubstr("sweep: 1 of 2 points are there already\n"));
  EXPECT_EQ(file("out/results.csv"), before);
}

TEST_F(SweepCommand, InterruptedItKeepsFinishedPointsOnlyAndExits130) {
  // The first point is short, the others would take hours; the signal comes when the bar shows that the first is
  // finished.
  write("interrupt.sh",
        "mkfifo bar\n"
        "'" DSDPV1_SIM
        "' sweep s.yaml --param end=600us,3000s,3600s --jobs 2 --out out --progress 2>bar & sweep=$!\n"
        "exec 3<bar\n"
        "until [[ $bar == *'#'* ]]; do read -r -d ']' bar <&3; done\n"
        "kill -TERM $sweep\n"
        "cat <&3 >err\n"
        "wait $sweep\n");
  const int status = std::system(("cd '" + folder_.path().string() + "' && bash interrupt.sh").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_THAT(file("err"), HasSubstr("sweep: interrupted, 1 of 3 points are kept"));
  std::vector<std::string> left;
  for (const auto& entry : fs::directory_iterator(folder_.file("out/points"))) left.push_back(entry.path().filename());
  EXPECT_THAT(left, testing::ElementsAre("00000.json"));
  EXPECT_FALSE(fs::exists(folder_.file("out/results.csv")));
}

TEST_F(SweepCommand, PointThatTheScenarioRefusesIsNotPossible) {
  const Called called = sweep("--param init.max_inputs=1 --param slaves.0.name=demo,bus --out out");
  EXPECT_EQ(called.status, 0) << called.err;
  EXPECT_THAT(called.out, HasSubstr("1 are not possible"));
  EXPECT_THAT(file("out/results.csv"), HasSubstr("not possible,2,"));
}

TEST_F(SweepCommand, ScenarioThatIsWrongAtEveryPointIsBadInput) {
  const Called called = sweep("--param slaves.0.name=bus,script --out out");
  EXPECT_EQ(called.status, 2);
  EXPECT_EQ(called.err, "s.yaml:4: name bus is taken, expected any other\n");
  EXPECT_FALSE(fs::exists(folder_.file("out")));
}

TEST_F(SweepCommand, WrongGsdFileAtEveryPointIsBadInput) {
  const Called called = sweep("--set slaves.0.gsd=none.gsd --param user_cpu.cycle=50us,60us --out out");
  EXPECT_EQ(called.status, 2);
  EXPECT_THAT(called.err, HasSubstr("none.gsd: no such file"));
}

}  // namespace
}  // namespace dsdpv1
