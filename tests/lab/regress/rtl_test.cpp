// Regressions with the reference RTL, and with RTL of one's own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>

#include "tests/app/program.hpp"

namespace dsdpv1 {
namespace {

using app_test::call;
using app_test::Called;
using testing::HasSubstr;

class RegressRtl : public testing::Test {
 protected:
  RegressRtl() {
    std::ofstream(folder_.file("s.yaml"))
        << "name: small\nbaud: 12M\nend: 600us\n"
           "slaves: [{name: demo, address: 5, init: {ident: 1, max_inputs: 1, max_outputs: 1, cfg: \"30\"}}]\n"
           "expect: [{slave: demo, event: INITIALISED}]\n";
  }
  Called regress(const std::string& arguments) const { return call("regress s.yaml " + arguments, folder_.path()); }

  app_test::Folder folder_;
};

TEST_F(RegressRtl, ImpossibleCombinationsAreLeftOutAndCounted) {
  const Called called = regress("--engine skip,lockstep --view pins,tlm --quiet");
  EXPECT_EQ(called.status, 0);
  EXPECT_THAT(called.err, HasSubstr("3 of 3 runs passed; 1 combinations that cannot be are left out; "));
  EXPECT_EQ(called.out, "");
}

TEST_F(RegressRtl, SeedIsThatOfTheRtl) {
  const Called called = regress("--engine skip,rtl --seed 2..3");
  EXPECT_EQ(called.status, 0) << called.err;
  EXPECT_THAT(called.out, HasSubstr("\npassed\ts.yaml\tskip\tpins\t\t"));
  EXPECT_THAT(called.out, HasSubstr("\npassed\ts.yaml\trtl\tpins\t2\t"));
  EXPECT_THAT(called.out, HasSubstr("\npassed\ts.yaml\trtl\tpins\t3\t"));
}

TEST_F(RegressRtl, EngineCosimNeedsRtlOfOnesOwnAndOneChip) {
  EXPECT_THAT(regress("--engine cosim").err, HasSubstr("--engine cosim and --rtl go together"));
  EXPECT_THAT(regress("--rtl . --top chip").err, HasSubstr("--engine cosim and --rtl go together"));
  std::ofstream(folder_.file("r.yaml")) << app_test::read(folder_.file("s.yaml")) << "chip: {kind: dsdpv1_r}\n";
  const Called called = regress("r.yaml --engine cosim --rtl . --top chip");
  EXPECT_EQ(called.status, 2);
  EXPECT_THAT(called.err, HasSubstr("r.yaml: is about a dsdpv1_r, s.yaml about a dsdpv1"));
}

/// The example, whose pulse of INTR0 has the given length; 64 is right.
class RegressOwnRtl : public RegressRtl {
 protected:
  RegressOwnRtl() {
    std::filesystem::copy(DSDPV1_SOURCE_DIR "/examples/own_rtl", folder_.file("own_rtl"));
    pulse(64);
  }
  void pulse(int cycles) const {
    std::ofstream(folder_.file("pins.yaml")) << app_test::read(folder_.file("own_rtl/pins.yaml"))
                                             << "parameters: {RESET_VALUE: 1, PULSE: " << cycles << "}\n";
  }
  Called verify(const std::string& arguments) const {
    return call("verify-rtl " + arguments + " --rtl own_rtl --top board_chip --pins pins.yaml --no-progress",
                folder_.path());
  }
  /// Where a run is kept whose name begins so.
  std::filesystem::path folder_of(const std::string& run) const {
    for (const auto& each : std::filesystem::directory_iterator(folder_.file("rtl-verification/runs")))
      if (each.is_directory() && each.path().filename().string().rfind(run, 0) == 0) return each.path();
    return {};
  }
  /// INTR0 falls in it.
  std::string scenario() const { return "'" DSDPV1_SOURCE_DIR "/scenarios/power_on_12m.yaml'"; }
};

TEST_F(RegressOwnRtl, IsVerifiedByEachWayAndOnlyWhatAChangeConcernsRunsAgain) {
  const std::string some = scenario() + " --only scenarios,random --cycles 200000 --junit rtl.xml";
  const Called first = verify(some);
  EXPECT_EQ(first.status, 0) << first.out << first.err;
  EXPECT_THAT(first.out, HasSubstr("power_on_12m.yaml\tcosim\tpins\t"));
  EXPECT_THAT(first.out, HasSubstr("\npassed\trandom\trandom\tpins\t1\t"));
  const std::string rulings = app_test::read(folder_.file("rtl-verification/rulings.tsv"));
  EXPECT_TRUE(std::regex_search(rulings, std::regex("\nS1\tchip.md#s1\texercised\t[0-9]+\t2\t"))) << "in both runs";
  EXPECT_TRUE(std::regex_search(rulings, std::regex("\nP8\tchip.md#p8\texercised\t[0-9]+\t1\t")))
      << "situations are those of random cases";
  const Called second = verify(some);
  EXPECT_EQ(second.out, first.out) << "with its times: nothing has run again";
  pulse(60);
  const Called changed = verify(some);
  EXPECT_EQ(changed.status, 1);
  EXPECT_THAT(changed.out, HasSubstr("pin INTR0: model no such change within the tolerance, RTL 1"));
  const std::string page = app_test::read(folder_.file("rtl-verification/index.html"));
  EXPECT_THAT(page, HasSubstr("sh rtl-verification/runs/power_on_12m.cosim.pins."));
  EXPECT_THAT(page, HasSubstr("difference.vcd"));
  const std::filesystem::path kept = folder_of("power_on_12m.cosim");
  EXPECT_TRUE(std::filesystem::exists(kept / "lockstep.stimulus")) << "what the chip of the scenario got";
  EXPECT_THAT(app_test::read(kept / "again.sh"), HasSubstr(" rtl-random --replay "));
  const Called again = call((kept / "again.sh").string(), "/", "sh");
  EXPECT_EQ(again.status, 1);
  EXPECT_THAT(again.out, HasSubstr("pin INTR0: model no such change within the tolerance, RTL 1"));
}

TEST_F(RegressOwnRtl, GoldenAndRegressionTakeItToo) {
  const std::string own = " --rtl own_rtl --top board_chip --pins pins.yaml";
  const Called golden = call("traces check power_on_12m" + own, folder_.path());
  EXPECT_EQ(golden.status, 2);
  EXPECT_THAT(golden.err, HasSubstr("pins.yaml: has a tolerance, goldens have none"));
  std::ofstream(folder_.file("plain.yaml")) << "reference: true\n";
  const Called reference = call("traces check power_on_12m --rtl '" DSDPV1_SOURCE_DIR
                                "/rtl_ref/dsdpv1' --top dsdpv1 --pins plain.yaml "
                                "--build reference --no-progress",
                                folder_.path());
  EXPECT_EQ(reference.status, 0) << reference.out << reference.err;
  const Called regression = regress("--engine skip,cosim" + own);
  EXPECT_EQ(regression.status, 0) << regression.err;
  EXPECT_THAT(regression.out, HasSubstr("\npassed\ts.yaml\tcosim\tpins\t\t"));
}

}  // namespace
}  // namespace dsdpv1
