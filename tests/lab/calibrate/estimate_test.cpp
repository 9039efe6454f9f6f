// One number out of many doubtful measurements.
#include "lab/calibrate/estimate.hpp"

#include <gtest/gtest.h>

namespace dsdpv1 {
namespace {

using calibrate::Estimate;
using calibrate::estimate;
using calibrate::Instance;
using calibrate::TimeBase;

Instance seen(double value, double doubt, bus::Tick at = 0) { return {at, {value - doubt, value + doubt}, value}; }

TEST(CalibrateEstimate, IsWhereMostMeasurementsAgree) {
  const Estimate result = estimate({seen(3, 2), seen(5, 2), seen(4, 2)});
  EXPECT_EQ(result.count, 3U);
  EXPECT_DOUBLE_EQ(result.span.lo, 3);
  EXPECT_DOUBLE_EQ(result.span.hi, 5);
  EXPECT_TRUE(result.outliers.empty());
  EXPECT_FALSE(result.whole()) << "3, 4 and 5 all fit";
  EXPECT_EQ(estimate({seen(3, 1.4), seen(5, 1.4)}).whole(), 4);
}

TEST(CalibrateEstimate, NamesWhoDoesNotAgreeAndByHowMuch) {
  const Estimate result = estimate({seen(4, 1, 10), seen(4, 1, 20), seen(9, 1, 30), seen(4, 1, 40), seen(2, 0.5, 50)});
  ASSERT_EQ(result.outliers.size(), 2U);
  EXPECT_EQ(result.outliers[0].at, 30);
  EXPECT_DOUBLE_EQ(result.outliers[0].by, 3);
  EXPECT_EQ(result.outliers[1].at, 50);
  EXPECT_DOUBLE_EQ(result.outliers[1].by, -0.5);
}

TEST(CalibrateEstimate, TakesTheMeanOnlyWhereClocksDriftPastTheSamples) {
  std::vector<Instance> instances;
  instances.reserve(1000);
  for (int i = 0; i < 1000; ++i) instances.push_back(seen(4, 2.4, i * bus::Tick{1'000'000}));
  TimeBase time;
  time.period = 2;
  time.jitter = 0.2;
  EXPECT_FALSE(estimate(instances, &time).by_mean) << "the scale may be 1";
  time.scale = {1 + 50e-6, 1 + 60e-6};
  EXPECT_TRUE(estimate(instances, &time).by_mean);
  EXPECT_EQ(estimate(instances, &time).whole(), 4);
}

TEST(CalibrateEstimate, OfNothingIsNothing) {
  EXPECT_EQ(estimate({}).count, 0U);
  EXPECT_FALSE(estimate({}).whole());
}

TEST(CalibrateEstimate, LeavesOutWhatNoNumberLiesIn) {
  const Instance none{0, {9, 8}, 8.5};
  EXPECT_EQ(estimate({none}).count, 0U);
  const Estimate result = estimate({none, seen(4, 1), none, seen(4.5, 1)});
  EXPECT_EQ(result.count, 2U);
  EXPECT_DOUBLE_EQ(result.span.lo, 3.5);
  EXPECT_DOUBLE_EQ(result.span.hi, 5);
  EXPECT_TRUE(result.outliers.empty());
}

TEST(CalibrateTimeBase, ScalesBothEndsAwayFromEachOther) {
  TimeBase time;
  time.period = 1;
  time.scale = {0.5, 2};
  const calibrate::Span span = time.between(0, 10 * bus::kTicksPerCycle);
  EXPECT_DOUBLE_EQ(span.lo, 4.5);
  EXPECT_DOUBLE_EQ(span.hi, 22);
  EXPECT_DOUBLE_EQ(time.between(10 * bus::kTicksPerCycle, 0).lo, -22);
}

}  // namespace
}  // namespace dsdpv1
