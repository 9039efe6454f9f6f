// Ruling P7, chapter 13 of the micro-architecture.
#include "model/dsdpv1/interrupt.hpp"

#include <gtest/gtest.h>

#include <random>

namespace dsdpv1 {
namespace {

TEST(InterruptBlock, PulseFallsTheCycleAfterTheTriggerAndLasts64) {
  Interrupt interrupt(64, 64);
  interrupt.reset();
  interrupt.trigger(100);
  for (Cycle now = 100; now < 400; ++now) {
    interrupt.eval(now);
    EXPECT_EQ(interrupt.level(), now < 101 || now >= 165) << now;
  }
  EXPECT_EQ(interrupt.next(), profibus::kNever);
}

TEST(InterruptBlock, TriggersAtEveryDistanceKeepFullPulsesAndTheGap) {
  for (Cycle distance = 2; distance < 300; ++distance) {  // two blocks are never closer
    Interrupt interrupt(64, 64);
    interrupt.reset();
    Cycle falls[2] = {0, 0};
    int pulses = 0;
    bool before = true;
    for (Cycle now = 0; now < 800; ++now) {
      if (now == 10 || now == 10 + distance) interrupt.trigger(now);
      interrupt.eval(now);
      if (before && !interrupt.level() && pulses < 2) falls[pulses++] = now;
      before = interrupt.level();
    }
    ASSERT_EQ(pulses, 2) << distance;
    EXPECT_EQ(falls[0], 11);
    EXPECT_EQ(falls[1], std::max<Cycle>(11 + distance, 11 + 128)) << distance;
  }
}

TEST(InterruptBlock, EvaluatedOnlyAtNextItIsTheSame) {
  std::mt19937 random(5);
  Interrupt every(64, 64), sparse(64, 64);
  every.reset();
  sparse.reset();
  for (Cycle now = 0; now < 200'000; ++now) {
    every.eval(now);
    if (now >= sparse.next()) {
      ASSERT_EQ(now, sparse.next()) << "next() lies in the past";
      sparse.eval(now);
    }
    ASSERT_EQ(every.level(), sparse.level()) << now;
    if (random() % 90 != 0) continue;
    every.trigger(now);
    sparse.trigger(now);
  }
}

}  // namespace
}  // namespace dsdpv1
