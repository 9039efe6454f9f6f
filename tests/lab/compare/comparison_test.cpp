// Equal and different waves, and the time of the difference: rules, windows, tolerance, clock, masks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/input/input_error.hpp"
#include "tests/lab/compare/waves.hpp"

namespace dsdpv1 {
namespace {

using compare_test::first;
using compare_test::vcd;
using compare_test::Waves;
using tb::compare::Options;
using tb::compare::Result;
using tb::compare::XRule;
using tb::compare::ZRule;
using testing::HasSubstr;

constexpr tb::compare::Femtoseconds kNs = 1'000'000;
const char* const kTwo = "wire 1 ! a\nwire 8 # d [7:0]";

class Compare : public testing::Test {
 protected:
  Result compare(const std::string& a, const std::string& b) const { return waves_.compare(a, b, options_); }
  std::string refusal(const std::string& a, const std::string& b) const {
    try {
      compare(a, b);
      return "none";
    } catch (const tb::InputError& error) {
      return error.what();
    }
  }
  Waves waves_;
  Options options_;
};

TEST_F(Compare, EqualWavesAreEqualWhateverTheOrderWithinATime) {
  const Result result = compare(vcd(kTwo, "#0\n0!\nb1 #\n#10\n1!\nb10 #\n#20\n"),
                                vcd("wire 8 X d[7:0]\nwire 1 Y a", "#0\nb01 X\n0Y\n#10\nb10 X\n1Y\n#20\n"));
  EXPECT_EQ(first(result), "equal");
  EXPECT_EQ(result.signals[0].compared, 2U);
  EXPECT_EQ(result.to, 20);
}

TEST_F(Compare, ADifferenceIsNamedWithItsTimeAndBothValues) {
  const Result result = compare(vcd(kTwo, "#0\n0!\nb0 #\n#10\n1!\n#15\nb11111111 #\n#30\n"),
                                vcd(kTwo, "#0\n0!\nb0 #\n#10\n1!\n#15\nb11110111 #\n#20\nb11111111 #\n#30\n"));
  EXPECT_EQ(first(result), "t.d@15: FF F7");
  EXPECT_EQ(result.signals[1].differences, 1U);
  EXPECT_EQ(result.signals[0].differences, 0U);
}

TEST_F(Compare, AChangeThatIsLateDiffersUntilItCame) {
  const Result result =
      compare(vcd(kTwo, "#0\n0!\n#10\n1!\n#20\n0!\n#40\n"), vcd(kTwo, "#0\n0!\n#11\n1!\n#21\n0!\n#40\n"));
  EXPECT_EQ(first(result), "t.a@10: 1 0");
  EXPECT_EQ(result.signals[0].differences, 2U);
}

TEST_F(Compare, ToleranceForgivesWhatDiffersNoLonger) {
  const std::string a = vcd(kTwo, "#0\n0!\n#10\n1!\n#40\n"), late = vcd(kTwo, "#0\n0!\n#13\n1!\n#40\n");
  options_.tolerance = 3 * kNs;
  EXPECT_EQ(first(compare(a, late)), "equal");
  EXPECT_EQ(first(compare(late, a)), "equal");
  options_.tolerance = 2 * kNs;
  EXPECT_EQ(first(compare(a, late)), "t.a@10: 1 0");
  EXPECT_EQ(first(compare(a, vcd(kTwo, "#0\n0!\n#40\n"))), "t.a@10: 1 0") << "never came";
}

TEST_F(Compare, TheFirstOfSeveralIsTheOneThatBeganFirst) {
  tb::compare::NamedPair exact, tolerant;
  exact.a = exact.b = "a";
  tolerant.a = tolerant.b = "d";
  tolerant.tolerance = 20 * kNs;
  options_.pairs = {exact, tolerant};
  const Result result = compare(vcd(kTwo, "#0\n0!\nb0 #\n#10\nb1 #\n#20\n1!\n#90\n"), vcd(kTwo, "#0\n0!\nb0 #\n#90\n"));
  EXPECT_EQ(first(result), "t.d@10: 01 00") << "although a was known to differ before";
}

TEST_F(Compare, DifferentTimeScalesAreOneTime) {
  const std::string a = vcd(kTwo, "#0\n0!\n#10400\n1!\n#30000\n", "1ps");
  const std::string rounded = vcd(kTwo, "#0\n0!\n#10\n1!\n#30\n");
  const Result result = compare(a, rounded);
  EXPECT_EQ(first(result), "t.a@10000: 0 1") << "10.4 ns, dumped as 10";
  EXPECT_EQ(result.tolerance, 1);
  EXPECT_EQ(result.rounded, 1000);
  EXPECT_EQ(first(compare(rounded, a)), "equal") << "A's unit is what its times say";
  EXPECT_EQ(first(compare(vcd(kTwo, "#0\n0!\n#12\n1!\n#30\n"), a)), "t.a@10400: 0 1");
  options_.tolerance = kNs;
  EXPECT_EQ(first(compare(a, rounded)), "equal");
  EXPECT_EQ(first(compare(a, vcd(kTwo, "#0\n0!\n#12\n1!\n#30\n"))), "t.a@10400: 1 0");
  options_.tolerance = 0;
  EXPECT_EQ(first(compare(rounded, a)), "t.a@10000: 1 0");
  EXPECT_EQ(first(compare(vcd(kTwo, "#0\n0!\n#5\n1!\n#6\n", "100 s"), vcd(kTwo, "#0\n0!\n#500\n1!\n#600\n", "1 s"))),
            "equal");
  EXPECT_THAT(refusal(vcd(kTwo, "#0\n0!\n#99999999\n1!\n", "100s"), vcd(kTwo, "#0\n0!\n#1\n", "1fs")),
              HasSubstr("has the time 99999999, which is beyond what can be compared"));
}

TEST_F(Compare, ACoarseUnitOfBMakesNothingEqual) {
  const std::string a = vcd(kTwo, "#0\n0!\n#1000000000000\n1!\n#2000000000000\n0!\n#3000000000000\n", "1ps");
  EXPECT_EQ(first(compare(a, vcd(kTwo, "#0\n1!\n#1\n0!\n#2\n1!\n#3\n", "1 s"))), "t.a@0: 0 1");
  EXPECT_EQ(first(compare(a, vcd(kTwo, "#0\n0!\n#1\n1!\n#2\n0!\n#3\n", "1 s"))), "equal");
}

TEST_F(Compare, WhatCannotDifferIsRefused) {
  const std::string still = vcd(kTwo, "#0\n0!\nb1 #\n"), a = vcd(kTwo, "#0\n0!\n#10\n1!\n#40\n");
  EXPECT_THAT(refusal(still, still), HasSubstr("a.vcd: has a single instant that was compared with"));
  EXPECT_EQ(first(compare(still, vcd(kTwo, "#0\n1!\nb1 #\n"))), "t.a@0: 0 1") << "a difference is one";
  EXPECT_THAT(refusal(vcd(kTwo, "#0\n0!\n#1\n", "1 s"), vcd(kTwo, "#0\n0!\n#900\n1!\n#1000\n", "1 ms")),
              HasSubstr("was compared with"))
      << "A's unit is as long as all of it";
  options_.tolerance = 40 * kNs;
  EXPECT_THAT(refusal(a, a), HasSubstr("from 0 ns to 40 ns, which is not longer than the tolerance of 40 ns"));
  options_.tolerance = 39 * kNs;
  EXPECT_EQ(first(compare(a, a)), "equal");
}

TEST_F(Compare, NothingComparedIsRefused) {
  const char* const clocked = "wire 1 ! a\nwire 1 c clk";
  const std::string a = vcd(clocked, "#0\n0!\n0c\n#10\n1!\n#20\n1c\n#40\n"),
                    twice = vcd(clocked, "#0\n0!\n0c\n#10\n1!\n#20\n1c\n#22\n0c\n#30\n1c\n#40\n");
  options_.masks = {tb::compare::parse_mask("clk!=x")};
  EXPECT_THAT(refusal(a, a), HasSubstr("has no value that was compared with"));
  options_.masks.clear();
  options_.clock = tb::compare::parse_clock("a:fall");
  EXPECT_THAT(refusal(a, a), HasSubstr("has no value that was compared with"));
  options_.clock = tb::compare::parse_clock("clk");
  EXPECT_THAT(refusal(a, a), HasSubstr("has a single instant that was compared with"));
  EXPECT_EQ(first(compare(twice, twice)), "equal");
}

TEST_F(Compare, EventsAreComparedByTheirMoments) {
  const char* const two = "event 1 e done\nwire 1 ! a";
  const std::string a = vcd(two, "#0\n1e\n0!\n#10\n1e\n#20\n1e\n#30\n1e\n#90\n");
  const std::string later = vcd(two, "#0\n0!\n#10\n1e\n#22\n1e\n#30\n1e\n#90\n");
  const std::string fewer = vcd(two, "#0\n0!\n#10\n1e\n#30\n1e\n#90\n");
  EXPECT_EQ(first(compare(a, vcd(two, "#0\n0!\n#10\n1e\n#20\n1e\n#30\n1e\n#90\n"))), "equal")
      << "simulators dump each event where the wave begins";
  EXPECT_EQ(first(compare(a, later)), "t.done@20: 2 1");
  EXPECT_EQ(first(compare(a, fewer)), "t.done@20: 2 1");
  options_.tolerance = 2 * kNs;
  EXPECT_EQ(first(compare(a, later)), "equal");
  EXPECT_EQ(first(compare(a, fewer)), "t.done@20: 2 1");
  options_.from = 25 * kNs;
  EXPECT_EQ(first(compare(a, fewer)), "equal") << "counted from there on";
  EXPECT_THAT(compare(a, vcd("wire 1 e done\nwire 1 ! a", "#0\n0!\n#90\n")).only_a, testing::ElementsAre("t.done"));
}

TEST_F(Compare, StrictlyASignalAloneAndAnEarlyEndAreDifferences) {
  const std::string a = vcd(kTwo, "#0\n0!\nb1 #\n#10\n1!\n#90\n"), only_a = vcd("wire 1 ! a", "#0\n0!\n#10\n1!\n#90\n"),
                    cut = vcd(kTwo, "#0\n0!\nb1 #\n#10\n1!\n#80\n");
  EXPECT_TRUE(compare(a, only_a).equal());
  options_.strict = true;
  EXPECT_TRUE(compare(a, a).equal());
  EXPECT_THAT(compare(a, only_a).alone, testing::ElementsAre("t.d"));
  EXPECT_FALSE(compare(a, only_a).equal());
  EXPECT_FALSE(compare(only_a, a).equal());
  EXPECT_FALSE(compare(a, cut).equal());
  EXPECT_TRUE(compare(cut, a).equal()) << "B may go on";
  options_.tolerance = 10 * kNs;
  EXPECT_TRUE(compare(a, cut).equal());
  options_.tolerance.reset();
  options_.to = 50 * kNs;
  EXPECT_TRUE(compare(a, cut).equal()) << "both reach --to";
}

TEST_F(Compare, UnknownBitsFollowTheRule) {
  const std::string known = vcd(kTwo, "#0\nb1010 #\n#9\n"), unknown = vcd(kTwo, "#0\nb10x0 #\n#9\n");
  const auto equal = [&](XRule rule, const std::string& a, const std::string& b) {
    options_.x = rule;
    tb::compare::NamedPair d;
    d.a = d.b = "d";
    options_.pairs = {d};
    return first(compare(a, b)) == "equal";
  };
  const std::string other = vcd(kTwo, "#0\nb11x0 #\n#9\n");
  EXPECT_TRUE(equal(XRule::kExpected, unknown, known));
  EXPECT_FALSE(equal(XRule::kExpected, known, unknown));
  EXPECT_TRUE(equal(XRule::kAny, known, unknown));
  EXPECT_FALSE(equal(XRule::kEqual, unknown, known));
  EXPECT_TRUE(equal(XRule::kEqual, unknown, unknown));
  EXPECT_FALSE(equal(XRule::kNever, unknown, unknown));
  EXPECT_FALSE(equal(XRule::kAny, known, other)) << "another bit differs";
}

TEST_F(Compare, ReleasedBitsFollowTheRule) {
  const std::string driven = vcd("wire 1 ! a", "#0\n1!\n#9\n"), released = vcd("wire 1 ! a", "#0\nz!\n#9\n");
  EXPECT_EQ(first(compare(released, driven)), "t.a@0: z 1");
  options_.z = ZRule::kExpected;
  EXPECT_EQ(first(compare(released, driven)), "equal");
  EXPECT_EQ(first(compare(driven, released)), "t.a@0: 1 z");
  options_.z = ZRule::kAny;
  EXPECT_EQ(first(compare(driven, released)), "equal");
}

TEST_F(Compare, RealsAreNumbersAndTextsMayHaveBlanksAsUnderlines) {
  const char* const kinds = "real 64 ! r\nstring 1 # s";
  EXPECT_EQ(first(compare(vcd(kinds, "#0\nr1.50 !\nsTO_DO #\n#9\n"), vcd(kinds, "#0\nr15e-1 !\nsTO_DO #\n#9\n"))),
            "equal");
  EXPECT_EQ(first(compare(vcd(kinds, "#0\nr1.5 !\n#9\n"), vcd(kinds, "#0\nr1.25 !\n#9\n"))), "t.r@0: 1.5 1.25");
  EXPECT_EQ(first(compare(vcd(kinds, "#0\nsIDLE #\n#9\n"), vcd(kinds, "#0\nsRUN #\n#9\n"))), "t.s@0: IDLE RUN");
  EXPECT_EQ(first(compare(vcd(kinds, "#0\nsit's_so #\n#9\n"), vcd(kinds, "#0\nsit\\'s\\040\\x73o #\n#9\n"))), "equal");
  EXPECT_EQ(first(compare(vcd(kinds, "#0\nsso #\n#9\n"), vcd(kinds, "#0\nss\\x70 #\n#9\n"))), "t.s@0: so sp");
}

TEST_F(Compare, OnlyTheWindowCounts) {
  const std::string a = vcd(kTwo, "#0\n0!\n#10\n1!\n#20\n0!\n#30\n1!\n#90\n");
  const std::string b = vcd(kTwo, "#0\n1!\n#20\n0!\n#25\n1!\n#90\n");
  options_.from = 12 * kNs;
  EXPECT_EQ(first(compare(a, b)), "t.a@25: 0 1");
  options_.to = 24 * kNs;
  EXPECT_EQ(first(compare(a, b)), "equal");
  options_.from = 5 * kNs;
  EXPECT_EQ(first(compare(a, b)), "t.a@5: 0 1") << "it differs when the window begins";
  options_.from = 95 * kNs;
  options_.to.reset();
  EXPECT_THAT(refusal(a, b), HasSubstr("has nothing to compare from 95 ns on: it goes from 0 ns to 90 ns"));
}

TEST_F(Compare, AFileThatEndsBeforeWhatWasAskedForIsNotEqual) {
  const std::string a = vcd(kTwo, "#0\n0!\n#10\n1!\n#90\n0!\n#99\n"), cut = vcd(kTwo, "#0\n0!\n#10\n1!\n#50\n");
  const Result result = compare(a, cut);
  EXPECT_TRUE(result.equal());
  EXPECT_EQ(result.to, 50);
  options_.to = 60 * kNs;
  EXPECT_FALSE(compare(a, cut).equal());
}

TEST_F(Compare, ShiftMovesBsTimes) {
  const std::string a = vcd(kTwo, "#0\n0!\n#10\n1!\n#30\n"), b = vcd(kTwo, "#100\n0!\n#110\n1!\n#130\n");
  options_.shift = -100 * kNs;
  EXPECT_EQ(first(compare(a, b)), "equal");
  options_.shift = -99 * kNs;
  EXPECT_EQ(first(compare(a, b)), "t.a@10: 1 0");
}

TEST_F(Compare, AtAClockEdgeOnlyWhatWasThereBeforeItCounts) {
  const char* const clocked = "wire 1 ! a\nwire 1 c clk";
  const std::string clock_a =
      "#0\n0c\n0!\n#10\n1c\n1!\n#15\n0!\n#16\n1!\n#20\n0c\n#30\n1c\n#35\n0c\n#40\n1c\n0!\n#50\n0c\n";
  const std::string b = vcd("wire 1 ! a", "#0\n0!\n#13\n1!\n#33\n0!\n#50\n");
  options_.clock = tb::compare::parse_clock("clk");
  const Result result = compare(vcd(clocked, clock_a), b);
  EXPECT_EQ(first(result), "t.a@40: 1 0");
  EXPECT_EQ(result.to, 50);
  options_.clock = tb::compare::parse_clock("clk:fall");
  EXPECT_EQ(first(compare(vcd(clocked, clock_a), b)), "t.a@35: 1 0");
  EXPECT_EQ(first(compare(b, vcd(clocked, clock_a))), "t.a@35: 0 1") << "the clock is B's alone";
  options_.clock = tb::compare::parse_clock("clock");
  EXPECT_THAT(refusal(vcd(clocked, clock_a), b), HasSubstr("a.vcd: has no signal clock"));
}

TEST_F(Compare, MasksHideWhileTheirConditionHolds) {
  const char* const three = "wire 1 ! a\nwire 8 # d [7:0]\nwire 1 o oe";
  const std::string a = vcd(three, "#0\n1o\nb0 #\n0!\n#10\n0o\n#20\nb1 #\n1!\n#30\n1o\n#90\n");
  const std::string b = vcd(three, "#0\n1o\nb0 #\n0!\n#10\n0o\n#20\n#30\n1o\n#90\n");
  EXPECT_EQ(first(compare(a, b)), "t.a@20: 1 0");
  options_.masks = {tb::compare::parse_mask("oe=0")};
  EXPECT_EQ(first(compare(a, b)), "t.a@30: 1 0") << "it still differs when the mask ends";
  options_.masks = {tb::compare::parse_mask("oe=0@a"), tb::compare::parse_mask("d!=0xFF@t.a")};
  EXPECT_EQ(first(compare(a, b)), "t.d@20: 01 00");
  options_.masks = {tb::compare::parse_mask("oe=0@q")};
  EXPECT_THAT(refusal(a, b), HasSubstr("--mask is for q, which is not compared"));
  options_.masks = {tb::compare::parse_mask("d=256")};
  EXPECT_THAT(refusal(a, b), HasSubstr("--mask d is 256, expected numbers of 8 bits"));
  options_.masks = {tb::compare::parse_mask("en=1")};
  EXPECT_THAT(refusal(a, b), HasSubstr("has no signal en"));
}

TEST_F(Compare, WhileASimulatorRecordsNothingNothingIsCompared) {
  const std::string a = vcd("wire 1 ! a", "#0\n0!\n#10\n1!\n#50\n0!\n#90\n");
  const std::string paused =
      vcd("wire 1 ! a", "#0\n0!\n#5\n$dumpoff\nx!\n$end\n#40\n$dumpon\n1!\n$end\n#60\n0!\n#90\n");
  EXPECT_EQ(first(compare(a, paused)), "t.a@50: 0 1");
}

TEST_F(Compare, BitsOfASplitVectorAreTheVector) {
  const std::string whole = vcd("wire 4 # d [3:0]", "#0\nb1010 #\n#10\nb1000 #\n#20\n");
  const char* const bits = "wire 1 A d [3]\nwire 1 B d [2]\nwire 1 C d [1]\nwire 1 D d [0]";
  EXPECT_EQ(first(compare(whole, vcd(bits, "#0\n1A\n0B\n1C\n0D\n#10\n0C\n#20\n"))), "equal");
  EXPECT_EQ(first(compare(whole, vcd(bits, "#0\n1A\n0B\n1C\n0D\n#10\n0C\n1D\n#20\n"))), "t.d@10: 8 9");
  EXPECT_EQ(first(compare(vcd("wire 2 A d [3:2]\nwire 2 B d [1:0]", "#0\nb10 A\nb10 B\n#10\nb0 B\n#20\n"), whole)),
            "equal");
}

}  // namespace
}  // namespace dsdpv1
