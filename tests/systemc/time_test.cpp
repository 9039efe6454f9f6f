#include <gtest/gtest.h>

#include "model/systemc/bound_clock.hpp"
#include "tests/systemc/bench.hpp"

using dsdpv1::Tick;
using dsdpv1::systemc::BoundClock;
using dsdpv1::systemc::to_tick;
using dsdpv1::systemc::to_time;
using sc_core::sc_time;

void simulate() { dsdpv1::systemc::require_femtoseconds(); }

namespace {

TEST(SimTime, ATickIsRoundedOnceToTheNearestFemtosecond) {
  EXPECT_EQ(to_time(1).value(), 83'333U);
  EXPECT_EQ(to_time(2).value(), 166'667U);
  EXPECT_EQ(to_time(3).value(), 250'000U);
  EXPECT_EQ(to_time(250).value(), 20'833'333U);
  EXPECT_EQ(to_time(12), sc_time(1, sc_core::SC_NS));
}

TEST(SimTime, NothingDriftsOverHours) {
  const Tick hour = 3600LL * 12'000'000'000;
  EXPECT_EQ(to_time(hour), sc_time(3600, sc_core::SC_SEC));
  EXPECT_EQ(to_time(5 * hour).value(), 18'000'000'000'000'000'000U);
  for (Tick tick = 5 * hour; tick < 5 * hour + 1000; ++tick) ASSERT_EQ(to_tick(to_time(tick)), tick);
}

TEST(SimTime, ATimeBetweenTicksGoesToTheNearest) {
  EXPECT_EQ(to_tick(sc_time::from_value(83'334)), 1);
  EXPECT_EQ(to_tick(sc_time::from_value(41'666)), 0);
  EXPECT_EQ(to_tick(sc_time::from_value(41'667)), 1);
  EXPECT_EQ(to_tick(sc_time::from_value(125'001)), 2);
}

TEST(BoundClock, CountsEdgesAndFollowsTimeBetweenThem) {
  BoundClock clock(3000);
  EXPECT_EQ(clock.chip_tick(to_time(50)), 0);
  clock.rising(to_time(100));
  EXPECT_EQ(clock.chip_tick(to_time(100)), 0);
  EXPECT_EQ(clock.chip_tick(to_time(160)), 60);
  clock.falling(to_time(225));
  EXPECT_EQ(clock.chip_tick(to_time(225)), 125);
  EXPECT_EQ(clock.chip_tick(to_time(255)), 155);
  clock.rising(to_time(350));
  EXPECT_EQ(clock.chip_tick(to_time(350)), 250);
}

TEST(BoundClock, NeverReachesAnEdgeBeforeItComes) {
  BoundClock clock(3000);
  clock.rising(to_time(0));
  EXPECT_EQ(clock.chip_tick(to_time(5000)), 124);
  clock.falling(to_time(5000));
  EXPECT_EQ(clock.chip_tick(to_time(90'000)), 249);
}

TEST(BoundClock, AFallingEdgeBeforeTheFirstRisingOneIsNoCycle) {
  BoundClock clock(3000);
  clock.falling(to_time(10));
  EXPECT_EQ(clock.chip_tick(to_time(500)), 0);
  EXPECT_EQ(clock.edges(), 0);
}

std::vector<double> wrong_frequencies(Tick period, int windows) {
  BoundClock clock(3000);
  std::vector<double> wrong;
  for (Tick edge = 0; edge <= windows * BoundClock::kWindow; ++edge) {
    clock.rising(to_time(edge * period));
    if (const auto mhz = clock.take_wrong_frequency()) wrong.push_back(*mhz);
  }
  return wrong;
}

TEST(BoundClock, AFrequencyOutOfTheToleranceIsReportedOnce) {
  EXPECT_TRUE(wrong_frequencies(250, 5).empty());
  const std::vector<double> slow = wrong_frequencies(252, 5);
  ASSERT_EQ(slow.size(), 1U);
  EXPECT_NEAR(slow[0], 48.0 * 250 / 252, 0.001);
}

}  // namespace
