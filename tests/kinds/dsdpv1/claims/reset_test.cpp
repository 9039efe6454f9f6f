// H6, and resets: the evidence for them if RESET is not in the capture, and what they cut.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/kinds/dsdpv1/claims/made_pins.hpp"

namespace dsdpv1::calibrate_test {
namespace {

using testing::IsEmpty;

constexpr double kCut = 2'071;  ///< cycle of the reset that add_cut_work makes

/// Accesses of which the last is cut after 3 cycles, and pulses of INTR0 of which the last is cut after 46.
void add_cut_work(MadePins& made) {
  made.accesses(100, 2'060);
  made.access(2'068, 3);
  made.show({wire::kIntr0}, true);
  made.low(wire::kIntr0, 105, 169);
  made.low(wire::kIntr0, 1'065, 1'129);
  made.low(wire::kIntr0, 2'025, kCut);
}

/// The start-up access and the next ones.
void add_start_up(MadePins& made, double start, double cycles = 2'054) {
  made.access(start, cycles);
  made.access(start + cycles + 1, 8);
  made.accesses(start + cycles + 49, start + cycles + 2'000);
}

MadePins made_accesses(bool user = true) {
  MadePins made;
  made.show({wire::kLReq, wire::kLSta});
  if (user) made.show({wire::kRReq, wire::kRSta});
  return made;
}

TEST(CalibrateReset, WithoutItsPinIsShownByTheStartUpAccess) {
  for (const bool user : {true, false}) {
    MadePins made = made_accesses(user);
    add_cut_work(made);
    add_start_up(made, 100'000);
    const calibrate::Result result = made.judged(105'000);
    EXPECT_THAT(contradicted(result), IsEmpty()) << user;
    EXPECT_EQ(claim(result, "H6", "").verdict, Verdict::kConfirmed) << user;
  }
}

TEST(CalibrateReset, WithoutItsPinIsShownByTheFallOfReady) {
  MadePins interrupt;  // without L_REQ
  interrupt.show({wire::kReady}, true);
  interrupt.show({wire::kLReq}, false);
  add_cut_work(interrupt);
  interrupt.set(kCut, wire::kReady, false);
  EXPECT_THAT(contradicted(interrupt.judged(50'000)), IsEmpty()) << "it ends within the reset";
  MadePins only_ready;
  only_ready.show({wire::kReady}, true);
  only_ready.show({wire::kIntr0}, true);
  only_ready.low(wire::kIntr0, 105, 169);
  only_ready.low(wire::kIntr0, 1'065, 1'129);
  only_ready.low(wire::kIntr0, 2'025, kCut);
  only_ready.set(kCut + 0.5, wire::kReady, false);
  EXPECT_THAT(contradicted(only_ready.judged(50'000)), IsEmpty()) << "the channels are half a cycle apart";
}

/// Pulses of INTR0 of these lengths, and nothing that shows a reset.
calibrate::Result judged_pulses(const std::vector<double>& lengths, Wire beside = wire::kIntr0) {
  MadePins made;
  made.show({wire::kIntr0}, true);
  if (beside != wire::kIntr0) made.show({beside}, true);
  double at = 100;
  for (const double length : lengths) {
    made.low(wire::kIntr0, at, at + length);
    at += 10'000;
  }
  return made.judged(at);
}

TEST(CalibrateReset, ThatNoPinShowsMayHaveCutAShortPulse) {
  for (const std::vector<double>& lengths :
       {std::vector<double>{64, 64, 46}, {46, 64}, {64, 46, 30}, {30, 64, 64, 50, 64}}) {
    const calibrate::Result result = judged_pulses(lengths);
    EXPECT_THAT(contradicted(result), IsEmpty()) << lengths.size();
    EXPECT_EQ(parameter(result, "intr_low").value, 64) << lengths.size();
  }
  const calibrate::ParameterResult one = parameter(judged_pulses({46}), "intr_low");
  EXPECT_EQ(one.verdict, Verdict::kNotContradicted);
  EXPECT_EQ(one.words, "at least 46");
}

TEST(CalibrateReset, DoesNotMakeAPulseLonger) {
  EXPECT_EQ(claim(judged_pulses({64, 64, 73}), "P7", "as long").tally.fails, 1U);
  EXPECT_EQ(parameter(judged_pulses({60, 60, 60}), "intr_low").verdict, Verdict::kContradicted);
  EXPECT_EQ(parameter(judged_pulses({73}), "intr_low").verdict, Verdict::kContradicted);
}

TEST(CalibrateReset, LetsBrFall) {
  EXPECT_EQ(claim(judged_pulses({64, 64, 46}, wire::kBr), "P7", "as long").tally.fails, 1U);
}

TEST(CalibrateReset, CutsWhatEndsJustBeforeItShows) {
  MadePins made = made_accesses();
  made.show({wire::kReset}, true);
  add_cut_work(made);
  made.low(wire::kReset, kCut + 0.5, 3'000);  // the channels are half a cycle apart
  add_start_up(made, 3'002.5);
  EXPECT_THAT(contradicted(made.judged(8'000)), IsEmpty());
}

TEST(CalibrateReset, ThatIsNotShownLeavesAShortAccessAndAPulseWrong) {
  MadePins made = made_accesses();
  add_cut_work(made);
  made.accesses(2'116, 6'000);
  const calibrate::Result result = made.judged(7'000);
  EXPECT_EQ(claim(result, "H3", "").tally.fails, 1U);
  EXPECT_EQ(claim(result, "P7", "as long").tally.fails, 1U);
}

TEST(CalibrateStartUp, WaitsForTheUserToo) {
  for (const bool pin : {true, false}) {
    MadePins made = made_accesses();
    made.accesses(100, 2'060);
    if (pin) made.show({wire::kReset}, true), made.low(wire::kReset, 90'000, 99'997.5);
    made.high(wire::kRReq, 99'990, 101'000);
    add_start_up(made, 100'000);
    EXPECT_EQ(claim(made.judged(105'000), "H1", "waits").verdict, Verdict::kContradicted) << pin;
  }
}

/// All blocks of the user and of the master at full length, in the middle of the operation.
MadePins with_long_access(double cycles) {
  MadePins made = made_accesses();
  made.accesses(100, 1'000);
  made.high(wire::kRReq, 1'000, 20'000);
  made.access(20'002.5, cycles);
  made.accesses(20'002.5 + cycles + 1, 30'000);
  return made;
}

TEST(CalibrateStartUp, IsNotALongAccessInTheOperation) {
  EXPECT_THAT(contradicted(with_long_access(2'204).judged(31'000)), IsEmpty()) << "only its length tells";
  for (const double cycles : {2'054, 2'204})
    for (const Wire wire : {wire::kReady, wire::kBr}) {
      MadePins made = with_long_access(cycles);
      made.show({wire}, true);
      EXPECT_EQ(claim(made.judged(31'000), "H6", "").verdict, Verdict::kNotShown)
          << calibrate::name_of(wire) << " " << cycles;
    }
  MadePins exchanging = with_long_access(2'204);
  exchanging.show({wire::kPbf}, false);
  exchanging.show({wire::kReset}, true);
  EXPECT_EQ(claim(exchanging.judged(31'000), "H6", "").verdict, Verdict::kNotShown);
}

TEST(CalibrateStartUp, OfAnotherLengthIsContradictedWhereAResetShows) {
  MadePins released = made_accesses();
  released.show({wire::kReset});
  released.set(100, wire::kReset, true);
  add_start_up(released, 102.5, 1'400);
  EXPECT_EQ(claim(released.judged(5'000), "H6", "").verdict, Verdict::kContradicted);
  MadePins not_ready = made_accesses();
  not_ready.show({wire::kReady});
  add_start_up(not_ready, 102.5, 2'100);
  EXPECT_EQ(claim(not_ready.judged(5'000), "H6", "").verdict, Verdict::kContradicted);
  MadePins silent = made_accesses();
  silent.show({wire::kBr}, true);  // whatever is wrong there
  silent.accesses(100, 2'060);
  add_start_up(silent, 100'000, 2'100);
  EXPECT_EQ(claim(silent.judged(105'000), "H6", "").verdict, Verdict::kContradicted);
}

TEST(CalibrateStartUp, ThatIsLongerThanAnyOtherAccessIsContradictedWithoutOtherPins) {
  for (const double cycles : {2'100, 2'500}) {
    MadePins made = made_accesses(false);
    add_start_up(made, 100, cycles);
    EXPECT_EQ(claim(made.judged(8'000), "H6", "").verdict,
              cycles > 2'424 ? Verdict::kContradicted : Verdict::kNotShown);
  }
}

}  // namespace
}  // namespace dsdpv1::calibrate_test
