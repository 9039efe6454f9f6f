// H1, H2, H3, D1, P7: captures of L_REQ with the user's pins, RESET and INTR0.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/kinds/dsdpv1/claims/made_pins.hpp"

namespace dsdpv1::calibrate_test {
namespace {

using testing::IsEmpty;

class MadeAccesses : public MadePins {
 public:
  MadeAccesses() { show({wire::kLReq, wire::kLSta}); }
};

/// Holds of 400 cycles; each leaves work for the chip, and 60 cycles later comes an access without.
void add_long_holds(MadeAccesses& made) {
  for (int at = 100; at < 30'000; at += 500) {
    made.high(wire::kRReq, at, at + 400);
    made.access(at + 403, 25);
    made.access(at + 451, 7);
  }
}

TEST(CalibrateAccess, AfterAHoldOfTheUserHasSomethingToDo) {
  MadeAccesses made;
  made.show({wire::kRReq, wire::kRSta});
  for (int at = 100; at < 30'000; at += 500) {
    made.high(wire::kRReq, at, at + 400);
    made.access(at + 403, 25);
    if (at == 100) made.access(at + 451, 7);
  }
  EXPECT_THAT(contradicted(made.judged(31'000)), IsEmpty());
}

TEST(CalibrateAccess, WithNothingToDoOfAnotherLengthIsAgainstH3) {
  MadeAccesses made;
  made.show({wire::kRReq, wire::kRSta});
  made.accesses(100, 5'000, 8);
  EXPECT_EQ(claim(made.judged(6'000), "H3", "").verdict, Verdict::kContradicted);
  MadeAccesses held;
  held.show({wire::kRReq, wire::kRSta});
  add_long_holds(held);
  EXPECT_EQ(claim(held.judged(31'000), "H3", "").tally.holds, 60U);
}

TEST(CalibrateAccess, OfAChipThatLooksSeldomMayAlwaysHaveSomethingToDo) {
  MadeAccesses made;
  made.show({wire::kRReq, wire::kRSta});
  for (int at = 100; at < 30'000; at += 600) made.access(at, 25);
  EXPECT_THAT(contradicted(made.judged(31'000)), IsEmpty());
}

TEST(CalibrateAccess, WithoutTheUsersPinsMayAlwaysHaveSomethingToDo) {
  MadeAccesses longer;
  longer.accesses(100, 5'000, 25);
  EXPECT_NE(claim(longer.judged(6'000), "H3", "").verdict, Verdict::kContradicted);
  MadeAccesses shorter;
  shorter.accesses(100, 5'000, 6);
  EXPECT_EQ(claim(shorter.judged(6'000), "H3", "").verdict, Verdict::kContradicted);
}

/// R is cycle 102, B004 is written 4096 cycles later, at the earliest.
MadeAccesses with_start_up(double start) {
  MadeAccesses made;
  made.access(start, 2'054);
  made.access(start + 2'055, 8);  // B012
  const double second = start + 2'055 + 48;
  const double at = second + 48 * std::ceil((102 + 4'096 - second) / 48);
  made.accesses(second, at);
  made.access(at, 8);
  made.accesses(at + 48, at + 1'000);
  return made;
}

/// The user has the DPRAM until cycle `released`.
void hold_until(double released, MadeAccesses& made) {
  made.show({wire::kRReq}, true);
  made.show({wire::kRSta});
  made.set(released, wire::kRReq, false);
}

TEST(CalibrateReady, CountsFromTheReleaseOfResetAndNotFromTheStartUpAccess) {
  MadeAccesses made = with_start_up(1'002.5);
  hold_until(1'000, made);
  made.show({wire::kReset});
  made.set(99.5, wire::kReset, true);
  const calibrate::ParameterResult found = parameter(made.judged(8'000), "ready_cycles");
  EXPECT_EQ(found.verdict, Verdict::kConfirmed) << found.words;
  EXPECT_LT(found.fit.estimate.span.width(), 55);
}

TEST(CalibrateReady, WithoutResetCountsFromAStartUpThatDidNotWaitForTheUser) {
  MadeAccesses waited = with_start_up(1'002.5);
  hold_until(1'000, waited);
  EXPECT_EQ(parameter(waited.judged(8'000), "ready_cycles").verdict, Verdict::kNotShown);
  EXPECT_EQ(parameter(with_start_up(102).judged(8'000), "ready_cycles").verdict, Verdict::kNotShown)
      << "the user's pins are not seen";
  MadeAccesses at_once = with_start_up(102);
  hold_until(40, at_once);
  EXPECT_EQ(parameter(at_once.judged(8'000), "ready_cycles").verdict, Verdict::kConfirmed);
}

/// The user has the DPRAM from 6'010 to 7'000 and reads B004 as C5.
MadeAccesses with_valid_flag_read() {
  MadeAccesses made = with_start_up(102);
  hold_until(40, made);
  made.show_host_port();
  made.high(wire::kRReq, 6'000, 7'000);
  made.high(wire::kRSta, 6'010, 7'000);
  made.read(6'100, 0x004, 0xC5);
  return made;
}

TEST(CalibrateReady, IsNotWhatTheUserHasWrittenThere) {
  MadeAccesses made = with_valid_flag_read();
  made.write(6'200, 0x004, 0x00);
  made.read(6'300, 0x004, 0x00);
  const calibrate::ParameterResult found = parameter(made.judged(8'000), "ready_cycles");
  EXPECT_EQ(found.verdict, Verdict::kConfirmed) << found.words;
}

TEST(CalibrateReady, IsNotWhatIsReadWithoutTheDpram) {
  MadeAccesses made = with_valid_flag_read();
  made.read(7'100, 0x004, 0x00);
  const calibrate::ParameterResult found = parameter(made.judged(8'000), "ready_cycles");
  EXPECT_EQ(found.verdict, Verdict::kConfirmed) << found.words;
}

TEST(CalibrateReady, OfReadsThatExcludeEachOtherIsNotShown) {
  MadeAccesses made = with_valid_flag_read();
  made.accesses(7'003, 7'100);
  made.high(wire::kRReq, 7'110, 8'000);
  made.high(wire::kRSta, 7'120, 8'000);
  made.read(7'200, 0x004, 0x00);
  EXPECT_EQ(parameter(made.judged(9'000), "ready_cycles").verdict, Verdict::kNotShown);
}

TEST(CalibrateAccess, ThatMayLieBetweenTwoSamplesShowsNothing) {
  for (const double rate : {6e6, 4e6, 2e6}) {
    MadeAccesses made;
    made.show({wire::kRReq, wire::kRSta});
    made.show({wire::kIntr0}, true);
    for (int i = 0; i < 2'000; ++i) made.access(100 + 48.003 * i, 7);
    made.low(wire::kIntr0, 105, 169);
    made.low(wire::kIntr0, 48'108, 48'172);
    const calibrate::Result result = made.sampled(97'000, rate);
    EXPECT_THAT(contradicted(result), IsEmpty()) << rate;
    EXPECT_EQ(parameter(result, "access_interval").verdict, Verdict::kNotShown) << rate;
  }
}

TEST(CalibrateAccess, InAReleaseThatLiesBetweenTwoSamplesIsNotAgainstH1) {
  MadeAccesses made;
  made.show({wire::kRReq, wire::kRSta});
  made.accesses(100, 1'000);
  made.high(wire::kRReq, 1'000, 2'000.5);
  made.high(wire::kRReq, 2'003.9, 2'500);  // 70 ns
  made.access(2'003, 7);
  made.access(2'503, 7);
  EXPECT_THAT(contradicted(made.sampled(2'520, 12e6)), IsEmpty());
}

TEST(CalibrateHandshake, ChipThatStartsMoreThanTwoCyclesAfterTheRequestIsAgainstH2) {
  for (const double late : {1.9, 2.5}) {
    MadeAccesses made;
    made.show({wire::kRReq, wire::kRSta});
    made.accesses(100, 1'000);
    made.high(wire::kRReq, 1'012 - late, 1'050);
    made.access(1'012, 7);
    made.access(1'060, 7);
    const calibrate::Result result = made.judged(2'000);
    EXPECT_EQ(claim(result, "H2", "").verdict, late < 2 ? Verdict::kConfirmed : Verdict::kContradicted) << late;
  }
}

TEST(CalibrateIntr0, GapOfWhichOnlyABoundIsSeenIsNotConfirmed) {
  MadeAccesses made;
  made.show({wire::kIntr0}, true);
  made.accesses(100, 3'000);
  made.low(wire::kIntr0, 105, 169);
  made.low(wire::kIntr0, 1'065, 1'129);
  const calibrate::ParameterResult gap = parameter(made.judged(4'000), "intr_gap");
  EXPECT_EQ(gap.words, "at most 896");
  EXPECT_STREQ(word(gap.verdict), "not contradicted");
  MadeAccesses shorter;
  shorter.show({wire::kIntr0}, true);
  shorter.accesses(100, 3'000);
  shorter.low(wire::kIntr0, 105, 169);
  shorter.low(wire::kIntr0, 201, 265);
  EXPECT_EQ(parameter(shorter.judged(4'000), "intr_gap").verdict, Verdict::kContradicted);
}

}  // namespace
}  // namespace dsdpv1::calibrate_test
