// Which changes of two sides count as the same.
#include <gtest/gtest.h>

#include "cosim/pin_comparator.hpp"
#include "kinds/dsdpv1/pins/pin_table.hpp"

namespace dsdpv1 {
namespace {

struct PinComparator : cosim::PinComparator {
  using cosim::PinComparator::PinComparator;
  void begin(Pin pin, Level model, Level rtl) { cosim::PinComparator::begin(number(pin), model, rtl); }
  void model_changed(Tick at, Pin pin, Level level) { cosim::PinComparator::model_changed(at, number(pin), level); }
  void rtl_changed(Tick at, Pin pin, Level level) { cosim::PinComparator::rtl_changed(at, number(pin), level); }
};

constexpr Tick kCycle = profibus::kTicksPerCycle;

cosim::Tolerances tolerance(Pin pin, int cycles) {
  cosim::Tolerances tolerances{};
  tolerances.at(static_cast<std::size_t>(pin)) = cycles;
  return tolerances;
}

TEST(PinComparator, SameChangesAreCounted) {
  PinComparator comparator;
  Level level = 0;
  for (const Tick at : {1000, 2000, 3000}) {
    level = level == 0 ? 1 : 0;
    comparator.model_changed(at, Pin::kPbtxd, level);
    comparator.rtl_changed(at, Pin::kPbtxd, level);
  }
  EXPECT_FALSE(comparator.settle(4000));
  EXPECT_EQ(comparator.matched(), 3U);
}

TEST(PinComparator, NothingIsSaidBeforeBothSidesHaveReachedATick) {
  PinComparator comparator;
  comparator.model_changed(1000, Pin::kBr, 1);
  EXPECT_FALSE(comparator.settle(1000));
  comparator.rtl_changed(1000, Pin::kBr, 1);
  EXPECT_FALSE(comparator.settle(1001));
}

TEST(PinComparator, LevelsAtTheBeginningAreCompared) {
  PinComparator comparator;
  comparator.begin(Pin::kIntr0, 1, 0);
  const auto difference = comparator.settle(1);
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->pin, number(Pin::kIntr0));
}

TEST(PinComparator, TheFirstDifferenceInTimeIsTheOneReported) {
  PinComparator comparator;
  comparator.model_changed(3000, Pin::kLReq, 1);
  comparator.rtl_changed(2000, Pin::kReady, 1);
  const auto difference = comparator.settle(4000);
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->at, 2000);
  EXPECT_EQ(difference->pin, number(Pin::kReady));
  EXPECT_EQ(*difference->model, 0);
  EXPECT_EQ(*difference->rtl, 1);
}

TEST(PinComparator, AGlitchWithinOneTickIsNoChange) {
  PinComparator comparator;
  comparator.rtl_changed(1000, Pin::kLSta, 1);
  comparator.rtl_changed(1000, Pin::kLSta, 0);
  EXPECT_FALSE(comparator.settle(2000));
}

TEST(PinComparator, UnknownDataOfTheModelMatchesEverything) {
  PinComparator comparator;
  comparator.begin(Pin::kDOut, dsdpv1::kLevelZ, dsdpv1::kLevelZ);
  comparator.model_changed(1000, Pin::kDOut, dsdpv1::kLevelX);
  comparator.rtl_changed(1000, Pin::kDOut, 0x77);
  EXPECT_FALSE(comparator.settle(1001));
  comparator.model_changed(1100, Pin::kDOut, 0x12);
  const auto difference = comparator.settle(1200);
  ASSERT_TRUE(difference);
  EXPECT_EQ(*difference->rtl, 0x77);
}

TEST(PinComparator, UnknownOutputsOfTheRtlMatchNothing) {
  PinComparator comparator;
  comparator.rtl_changed(1000, Pin::kPbrts, dsdpv1::kLevelX);
  EXPECT_TRUE(comparator.settle(1001));
}

TEST(PinComparator, TolerantPinMayBeEarlierOrLaterByItsCycles) {
  PinComparator comparator(tolerance(Pin::kIntr0, 2));
  comparator.model_changed(10 * kCycle, Pin::kIntr0, 1);
  comparator.rtl_changed(12 * kCycle, Pin::kIntr0, 1);
  comparator.rtl_changed(18 * kCycle, Pin::kIntr0, 0);
  comparator.model_changed(20 * kCycle, Pin::kIntr0, 0);
  EXPECT_FALSE(comparator.settle(40 * kCycle));
  EXPECT_EQ(comparator.matched(), 2U);
}

TEST(PinComparator, TolerantPinThatIsTooLateIsADifference) {
  PinComparator comparator(tolerance(Pin::kIntr0, 2));
  comparator.model_changed(10 * kCycle, Pin::kIntr0, 1);
  comparator.rtl_changed(12 * kCycle + 1, Pin::kIntr0, 1);
  EXPECT_TRUE(comparator.settle(40 * kCycle));
}

TEST(PinComparator, TolerantPinThatNeverFollowsIsADifferenceWhenItsTimeIsOver) {
  PinComparator comparator(tolerance(Pin::kBr, 5));
  comparator.model_changed(10 * kCycle, Pin::kBr, 1);
  EXPECT_FALSE(comparator.settle(15 * kCycle));
  const auto difference = comparator.settle(16 * kCycle);
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->at, 10 * kCycle);
  EXPECT_FALSE(difference->rtl);
}

TEST(PinComparator, TolerantPinMustMakeTheSameChanges) {
  PinComparator comparator(tolerance(Pin::kPbf, 5));
  comparator.begin(Pin::kPbf, 1, 1);
  comparator.model_changed(10 * kCycle, Pin::kPbf, 0);
  comparator.rtl_changed(9 * kCycle, Pin::kPbf, dsdpv1::kLevelX);
  EXPECT_TRUE(comparator.settle(20 * kCycle));
}

}  // namespace
}  // namespace dsdpv1
