// The first lines of a second are printed, the others counted.
#include "tb/serve/line_limit.hpp"

#include <gtest/gtest.h>

namespace dsdpv1 {
namespace {

using tb::serve::LineLimit;
using tb::serve::WallTime;

constexpr WallTime kNow{};

TEST(LineLimit, WhatIsTooMuchForASecondIsCounted) {
  LineLimit limit;
  for (std::uint64_t i = 0; i < LineLimit::kMost; ++i) EXPECT_TRUE(limit.allows(kNow)) << i;
  for (int i = 0; i < 990; ++i) EXPECT_FALSE(limit.allows(kNow + LineLimit::kSpan / 2));
  EXPECT_EQ(limit.left_out(kNow + LineLimit::kSpan / 2), 0U) << "more may come in this second";
  EXPECT_EQ(limit.left_out(kNow + LineLimit::kSpan), 990U);
  EXPECT_EQ(limit.left_out(kNow + 2 * LineLimit::kSpan), 0U) << "told once";
  EXPECT_TRUE(limit.allows(kNow + LineLimit::kSpan)) << "a new second";
}

TEST(LineLimit, FewLinesAreAllSaid) {
  LineLimit limit;
  for (int second = 0; second < 5; ++second) {
    const WallTime now = kNow + second * LineLimit::kSpan;
    EXPECT_EQ(limit.left_out(now), 0U);
    EXPECT_TRUE(limit.allows(now));
  }
}

TEST(LineLimit, AtTheEndTheCountIsNotWaitedFor) {
  LineLimit limit;
  for (std::uint64_t i = 0; i < LineLimit::kMost + 1; ++i) limit.allows(kNow);
  EXPECT_EQ(limit.left_out(kNow, false), 1U);
}

}  // namespace
}  // namespace dsdpv1
