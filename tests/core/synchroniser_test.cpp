// Ruling P9.
#include "model/profibus/synchroniser.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace dsdpv1::profibus {
namespace {

TEST(SynchroniserBlock, AChangeIsUsedTwoEdgesAfterTheOneThatSamplesIt) {
  for (Tick phase = 0; phase < 2 * kTicksPerCycle; ++phase) {
    Synchroniser input(false);
    const Tick at = 5000 + phase;
    input.set(at, true);
    const Cycle used = at / 250 + 1 + 2;
    for (Cycle now = 20; now < used; ++now) {
      EXPECT_FALSE(input.eval(now));
      EXPECT_FALSE(input.level());
    }
    EXPECT_EQ(input.next(), used);
    EXPECT_TRUE(input.eval(used));
    EXPECT_TRUE(input.level());
  }
}

TEST(SynchroniserBlock, APulseThatNoEdgeSamplesVanishes) {
  Synchroniser input(true);
  input.set(1001, false);
  input.set(1249, true);
  for (Cycle now = 4; now < 20; ++now) {
    EXPECT_FALSE(input.eval(now));
    EXPECT_TRUE(input.level());
  }
}

/// Two flip-flops and the pin, edge by edge; and the block evaluated always and only at next().
TEST(SynchroniserBlock, RandomInputsAreThoseOfTwoFlipFlopsAlsoWhenEvaluatedOnlyAtNext) {
  std::mt19937 random(11);
  Synchroniser every(false), sparse(false);
  bool pin = false, first = false, second = false, third = false;
  Tick next_change = 100;
  for (Cycle now = 0; now < 100'000; ++now) {
    third = second;  // the level for the logic at this edge: sampled two edges ago
    second = first;
    first = pin;
    every.eval(now);
    if (now >= sparse.next()) sparse.eval(now);
    ASSERT_EQ(every.level(), third) << now;
    ASSERT_EQ(sparse.level(), third) << now;
    for (; next_change < (now + 1) * kTicksPerCycle; next_change += 1 + static_cast<Tick>(random() % 700)) {
      if (next_change < now * kTicksPerCycle) continue;
      pin = !pin;
      every.set(next_change, pin);
      sparse.set(next_change, pin);
    }
  }
}

}  // namespace
}  // namespace dsdpv1::profibus
