// Invalid or damaged waves: one line, exit 2, and no outputs are left.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/app/program.hpp"
#include "tests/lab/compare/waves.hpp"

namespace dsdpv1 {
namespace {

using app_test::call;
using app_test::Called;
using compare_test::vcd;
using testing::HasSubstr;

class BadWaves : public testing::Test {
 protected:
  void SetUp() override { waves_.write("good.vcd", vcd("wire 1 ! a", "#0\n0!\n#10\n1!\n#20\n")); }
  /// The error for the command line; it must be one line with exit code 2.
  std::string refusal(const std::string& arguments) const {
    const Called called = call("compare " + arguments, waves_.folder());
    EXPECT_EQ(called.status, 2) << arguments;
    EXPECT_EQ(called.out, "") << arguments;
    EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
    return called.err;
  }
  std::string refusal_of(const std::string& content) const {
    waves_.write("bad", content);
    std::string said = refusal("good.vcd bad --wave out.vcd --json out.json");
    EXPECT_EQ(refusal("bad good.vcd"), said);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(waves_.folder()), {}), 2) << "an output was left";
    return said;
  }
  compare_test::Waves waves_;
};

TEST_F(BadWaves, AreRefusedInOneLine) {
  const std::string good = vcd("wire 1 ! a", "#0\n0!\n#10\n1!\n#20\n");
  EXPECT_THAT(refusal_of(""), HasSubstr("bad: is empty"));
  EXPECT_THAT(refusal_of("\x1b[2J not a wave"), HasSubstr("bad:1: \"\\x1B[2J\" stands where"));
  EXPECT_THAT(refusal_of(good.substr(0, good.size() / 2)), HasSubstr("ends within"));
  EXPECT_THAT(refusal_of(good.substr(0, good.size() - 2)), HasSubstr("bad:10: ends within a line"));
  EXPECT_THAT(refusal_of(good + "#5\n"), HasSubstr("bad:11: time 5 comes after 20"));
  EXPECT_THAT(refusal_of(std::string(100'000, '\0')), HasSubstr("bad: is no wave"));
  EXPECT_THAT(refusal_of(std::string(100'000, '\xff')), HasSubstr("bad"));
  EXPECT_THAT(refusal_of("GHDLwave\n"), HasSubstr("bad: is GHW of GHDL"));
  EXPECT_THAT(refusal_of("$var wire 4000000000 ! a $end\n"), HasSubstr("has the size 4000000000"));
}

TEST_F(BadWaves, AndSoAreWrongOptions) {
  EXPECT_THAT(refusal("good.vcd none.vcd"), HasSubstr("none.vcd: no such file"));
  EXPECT_THAT(refusal("good.vcd"), HasSubstr("B is missing (dsdpv1-sim compare A B)"));
  EXPECT_THAT(refusal("good.vcd good.vcd --tolerance 5"), HasSubstr("--tolerance is 5, expected a number with a unit"));
  EXPECT_THAT(refusal("good.vcd good.vcd --from -5ns"), HasSubstr("--from is -5ns"));
  EXPECT_THAT(refusal("good.vcd good.vcd --x sometimes"), HasSubstr("--x is sometimes, expected expected, any"));
  EXPECT_THAT(refusal("good.vcd good.vcd --z never"), HasSubstr("--z is never, expected equal, expected, any"));
  EXPECT_THAT(refusal("good.vcd good.vcd --mask a"), HasSubstr("--mask is a, expected SIGNAL=VALUE"));
  EXPECT_THAT(refusal("good.vcd good.vcd --signal a"), HasSubstr("--signal is a, expected A=B"));
  EXPECT_THAT(refusal("good.vcd good.vcd --pins none.yaml"), HasSubstr("none.yaml: no such file"));
  EXPECT_THAT(refusal("good.vcd good.vcd --wave both.png"), HasSubstr("expected .vcd or .fst"));
  EXPECT_THAT(refusal("good.vcd good.vcd --json good.vcd"), HasSubstr("--json would replace"));
  EXPECT_THAT(refusal("good.vcd good.vcd --from 1ms"), HasSubstr("has nothing to compare from 1000000 ns on"));
  EXPECT_THAT(refusal("good.vcd good.vcd --from 5ns --to 5ns --wave out.vcd"), HasSubstr("has a single instant"));
  EXPECT_THAT(refusal("good.vcd good.vcd --without a"), HasSubstr("--without is for --pins, expected both"));
}

}  // namespace
}  // namespace dsdpv1
