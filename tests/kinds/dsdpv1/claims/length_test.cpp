// H3: how long accesses with nothing to do are, where the samples of an analyser hide a cycle of each.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/kinds/dsdpv1/claims/made_pins.hpp"

namespace dsdpv1::calibrate_test {
namespace {

using testing::IsEmpty;

constexpr double k24MHz = 24e6;

/// So many cycles each, one every 48 cycles of a clock that is slower than the analyser's by some ppm; every `busy`-th
/// takes 5 cycles more.
calibrate::Result judged(double cycles, double ppm, int busy = 0, bool user = true) {
  constexpr int kAccesses = 3'000;
  const double interval = 48 * (1 + ppm * 1e-6);
  MadePins made;
  made.show({wire::kLReq, wire::kLSta});
  if (user) made.show({wire::kRReq, wire::kRSta});
  for (int i = 0; i < kAccesses; ++i) made.access(100 + interval * i, busy != 0 && i % busy == 0 ? cycles + 5 : cycles);
  return made.sampled(200 + interval * kAccesses, k24MHz);
}

TEST(CalibrateLength, OfSevenCyclesIsConfirmedByTheMean) {
  const calibrate::Result result = judged(7, 62);
  EXPECT_THAT(contradicted(result), IsEmpty());
  EXPECT_EQ(claim(result, "H3", "").verdict, Verdict::kConfirmed);
}

TEST(CalibrateLength, OfSomeAccessesMayBeMore) {
  for (const int busy : {4, 14}) EXPECT_THAT(contradicted(judged(7, 62, busy)), IsEmpty()) << busy;
}

TEST(CalibrateLength, OfAnotherNumberOfCyclesIsContradictedByTheMean) {
  for (const double cycles : {6, 8, 9}) {
    EXPECT_EQ(claim(judged(cycles, 62), "H3", "").verdict, Verdict::kContradicted) << cycles;
    EXPECT_EQ(claim(judged(cycles, -62, 14), "H3", "").verdict, Verdict::kContradicted) << cycles;
  }
}

TEST(CalibrateLength, IsNotConfirmedWhereTheSamplesHideACycle) {
  for (const double cycles : {7, 8})
    EXPECT_EQ(claim(judged(cycles, 0), "H3", "").verdict, Verdict::kNotShown) << "no drift, " << cycles;
  EXPECT_EQ(claim(judged(8, 62, 0, false), "H3", "").verdict, Verdict::kNotShown) << "the user's pins are not seen";
}

}  // namespace
}  // namespace dsdpv1::calibrate_test
