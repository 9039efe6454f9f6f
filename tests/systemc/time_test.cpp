// Ticks and simulation time at the resolution from the environment, which is a property of the process.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "model/systemc/bound_clock.hpp"
#include "tests/systemc/bench.hpp"

namespace dsdpv1 {

using dsdpv1::systemc::BoundClock;
using dsdpv1::systemc::to_tick;
using dsdpv1::systemc::to_time;
using sc_core::sc_time;

void simulate() { set_resolution(); }

namespace {

/// The resolution; three ticks are 250 ps.
std::int64_t femtoseconds() { return std::llround(sc_core::sc_get_time_resolution().to_seconds() * 1e15); }
std::int64_t units_per_three_ticks() { return 250'000 / femtoseconds(); }

/// Five hours at 1 fs, five thousand at 1 ps: the range of SystemC's time.
Tick random_tick() {
  static std::mt19937_64 random(20261124);
  return static_cast<Tick>(random() % (18'000ULL * 12'000'000'000 * static_cast<std::uint64_t>(femtoseconds())));
}

/// The error of a tick's time, in thirds of a unit.
std::int64_t thirds_off(Tick tick) {
  const std::uint64_t whole =
      static_cast<std::uint64_t>(tick) / 3 * static_cast<std::uint64_t>(units_per_three_ticks());
  return 3 * static_cast<std::int64_t>(to_time(tick).value() - whole) - tick % 3 * units_per_three_ticks();
}

TEST(SimTime, TheTimeOfATickIsOffByAThirdOfTheResolutionAtMost) {
  const auto unit = static_cast<double>(femtoseconds());
  EXPECT_EQ(to_time(1).value(), static_cast<std::uint64_t>(std::llround(250'000.0 / 3 / unit)));
  EXPECT_EQ(to_time(250).value(), static_cast<std::uint64_t>(std::llround(62'500'000.0 / 3 / unit)));
  for (int i = 0; i < 100'000; ++i) {
    const Tick tick = random_tick();
    ASSERT_LE(std::abs(thirds_off(tick)), 1) << tick;
  }
}

TEST(SimTime, ATickIsTheSameAfterTheWayToTimeAndBack) {
  for (int i = 0; i < 100'000; ++i) {
    const Tick tick = random_tick();
    ASSERT_EQ(to_tick(to_time(tick)), tick);
  }
}

TEST(SimTime, NothingDriftsOverHours) {
  const Tick hour = 3600LL * 12'000'000'000;
  EXPECT_EQ(to_time(12), sc_time(1, sc_core::SC_NS));
  EXPECT_EQ(to_time(hour), sc_time(3600, sc_core::SC_SEC));
  EXPECT_EQ(to_time(5 * hour).value(), 5 * to_time(hour).value());
  for (Tick tick = 5 * hour; tick < 5 * hour + 1000; ++tick) ASSERT_EQ(to_tick(to_time(tick)), tick);
}

TEST(SimTime, ATimeBetweenTicksGoesToTheNearest) {
  const std::int64_t half = units_per_three_ticks() / 6;  // 41.7 ps, rounded down: still nearer to the tick
  for (int i = 0; i < 100'000; ++i) {
    const Tick tick = 3 + random_tick();
    const std::uint64_t time = to_time(tick).value();
    const auto beside = static_cast<std::uint64_t>(i % (half - 1));
    ASSERT_EQ(to_tick(sc_time::from_value(time - beside)), tick) << beside;
    ASSERT_EQ(to_tick(sc_time::from_value(time + beside)), tick) << beside;
    ASSERT_NE(to_tick(sc_time::from_value(time + static_cast<std::uint64_t>(half) + 2)), tick);
  }
}

TEST(SimTime, HalfWayBetweenTwoTicksIsTheLater) {
  EXPECT_EQ(to_tick(sc_time::from_value(static_cast<std::uint64_t>(units_per_three_ticks() / 2))), 2);
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
}  // namespace dsdpv1
