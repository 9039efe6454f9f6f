// S1, S10: the end of the search and its time, in synthetic captures.
#include <gtest/gtest.h>

#include "tests/kinds/dsdpv1/claims/made_capture.hpp"

namespace dsdpv1::calibrate_test {
namespace {

struct Verdicts {
  Verdict s1, s10;
};

/// BR rises so many bit times after the decision of a telegram to another station.
Verdicts rise(double bits) {
  MadeCapture capture(k1M5, {wire::kBr});
  capture.request(fdl_status(kMaster, kStation + 1), 100);
  capture.decide();
  capture.wait_bits(bits);
  capture.set(wire::kBr, true);
  const calibrate::Result result = capture.judge();
  return {claim(result, "S1", "ends the search").verdict, claim(result, "S10", "BR rises").verdict};
}

TEST(CalibrateSearch, EndsWithARightTelegramAtItsDecision) {
  const Verdicts at_decision = rise(0);
  EXPECT_EQ(at_decision.s1, Verdict::kConfirmed);
  EXPECT_EQ(at_decision.s10, Verdict::kConfirmed);
}

TEST(CalibrateSearch, AnotherMomentIsAgainstS10Alone) {
  for (const double bits : {-1.0, 3.0}) {
    EXPECT_EQ(rise(bits).s1, Verdict::kConfirmed) << bits;
    EXPECT_EQ(rise(bits).s10, Verdict::kContradicted) << bits;
  }
}

TEST(CalibrateSearch, MayEndWithATelegramThatACoarseCaptureDoesNotShow) {
  const auto judged = [](double bits) {
    MadeCapture capture(k12M, {wire::kBr});
    for (int i = 0; i < 2; ++i) capture.request(fdl_status(kMaster, kStation + 1), 100);
    capture.request_unread(fdl_status(kMaster, kStation + 1));
    capture.decide();
    capture.wait_bits(bits);
    capture.set(wire::kBr, true);
    return claim(capture.judge_sampled(24e6), "S1", "ends the search").verdict;
  };
  EXPECT_EQ(judged(0), Verdict::kNotShown);
  EXPECT_EQ(judged(500), Verdict::kContradicted);
}

TEST(CalibrateSearch, MayEndWithTheTelegramInWhichTheCaptureBegins) {
  MadeCapture whole(k1M5, {wire::kBr});
  whole.find_rate();
  const Tick rise = whole.now();
  whole.exchange(fdl_status(), status(0));
  for (int bits = 1; bits < 70; ++bits) {
    MadeCapture capture = whole;
    capture.begin_at(rise - static_cast<Tick>(bits * capture.bit()));
    EXPECT_EQ(contradicted(capture.judge()), "") << bits;
  }
}

TEST(CalibrateSearch, AnEndWithoutATelegramIsAgainstS1Alone) {
  EXPECT_EQ(rise(500).s1, Verdict::kContradicted);
  EXPECT_EQ(rise(500).s10, Verdict::kNotShown);
}

}  // namespace
}  // namespace dsdpv1::calibrate_test
