// Simulated time compared with real time, with a clock that the test sets.
#include "tb/serve/pace.hpp"

#include <gtest/gtest.h>

namespace dsdpv1 {
namespace {

using bus::kTicksPerMs;
using std::chrono::milliseconds;
using tb::serve::Pace;
using tb::serve::WallTime;

class PaceTest : public testing::Test {
 protected:
  WallTime now_{};
  Pace pace_{[this] { return now_; }, 5 * kTicksPerMs};
};

TEST_F(PaceTest, SimulatedTimeIsWantedToFollowTheClock) {
  EXPECT_EQ(pace_.target(), 5 * kTicksPerMs);
  now_ += milliseconds(7);
  EXPECT_EQ(pace_.target(), 12 * kTicksPerMs);
  EXPECT_EQ(pace_.wall(12 * kTicksPerMs), now_);
}

TEST_F(PaceTest, ErrorIsRealMinusSimulatedTime) {
  now_ += milliseconds(1);
  EXPECT_FALSE(pace_.check(6 * kTicksPerMs));
  now_ += milliseconds(3);
  EXPECT_FALSE(pace_.check(7 * kTicksPerMs));
  EXPECT_EQ(pace_.statistics().error_max_us, 2000);
  EXPECT_EQ(pace_.statistics().error_mean_us(), 1000);
}

TEST_F(PaceTest, ALagThatIsTooLongIsGivenUpAndReported) {
  now_ += milliseconds(202);
  const auto loss = pace_.check((5 + 101) * kTicksPerMs);
  ASSERT_TRUE(loss);
  EXPECT_EQ(loss->lag, 101 * kTicksPerMs);
  EXPECT_DOUBLE_EQ(loss->speed, 0.5);
  EXPECT_EQ(pace_.target(), (5 + 101) * kTicksPerMs) << "simulated time goes on from where it is";
  EXPECT_FALSE(pace_.check((5 + 101) * kTicksPerMs));
  EXPECT_EQ(pace_.statistics().losses, 1U);
  EXPECT_EQ(pace_.statistics().lost, 101 * kTicksPerMs);
}

TEST_F(PaceTest, TimeThatStoodStillOnPurposeIsCaughtUpAndIsNoError) {
  now_ += milliseconds(290);
  pace_.hold(290 * kTicksPerMs);
  EXPECT_FALSE(pace_.check(5 * kTicksPerMs));
  EXPECT_EQ(pace_.statistics().samples, 0U);
  EXPECT_FALSE(pace_.check((5 + 290) * kTicksPerMs));
  now_ += milliseconds(150);
  EXPECT_TRUE(pace_.check((5 + 290) * kTicksPerMs)) << "the allowance ends when simulated time has caught up";
}

}  // namespace
}  // namespace dsdpv1
