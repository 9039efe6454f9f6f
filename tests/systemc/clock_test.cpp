// A bound CLK: its frequency is checked, and only its edges make the chip's cycles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "tests/systemc/bench.hpp"

namespace dsdpv1 {

using sc_core::sc_clock;
using sc_core::sc_time;
using testing::HasSubstr;

namespace {

struct World {
  sc_clock right{"right", sc_time(20.8333, sc_core::SC_NS)};
  sc_clock slow{"slow", sc_time(21, sc_core::SC_NS)};
  sc_core::sc_signal<bool> dead{"dead"};
  PinBench on_time{"on_time"}, late{"late"}, tolerant{"tolerant", tolerant_options()}, stopped{"stopped"},
      unbound{"unbound"};
  std::vector<sc_time> late_rises;

  World() {
    on_time.chip.CLK(right);
    late.chip.CLK(slow);
    tolerant.chip.CLK(slow);
    stopped.chip.CLK(dead);
    for (PinBench* bench : {&on_time, &late, &tolerant, &stopped, &unbound}) {
      thread([bench] {
        wait_until(100);
        bench->drive(Pin::kReset, 1);
      });
    }
    method_on(late.l_req.posedge_event(), [this] { late_rises.push_back(sc_core::sc_time_stamp()); });
  }

  static dsdpv1::systemc::PinOptions tolerant_options() {
    dsdpv1::systemc::PinOptions options;
    options.clock_tolerance_ppm = 10'000;
    return options;
  }
};

std::unique_ptr<World> world;

}  // namespace

void simulate() {
  set_resolution();
  collect_reports();
  world = std::make_unique<World>();
  sc_core::sc_start(100, sc_core::SC_US);
}

namespace {

TEST(Clock, TheRightFrequencyIsNotReported) {
  EXPECT_TRUE(reports_of("/dsdpv1/clock", "on_time").empty());
  EXPECT_TRUE(reports_of("/dsdpv1/clock", "unbound").empty());
}

TEST(Clock, AWrongFrequencyIsReportedOnceWithTheMeasuredValue) {
  EXPECT_THAT(reports_of("/dsdpv1/clock", "late"),
              testing::ElementsAre("late: CLK is 47.619048 MHz, expected 48 MHz +/- 3000.000000 ppm"));
}

TEST(Clock, TheToleranceIsAParameter) { EXPECT_TRUE(reports_of("/dsdpv1/clock", "tolerant").empty()); }

TEST(Clock, AClkThatNeverTogglesIsReported) {
  EXPECT_THAT(reports_of("/dsdpv1/clock", "stopped"), testing::ElementsAre(HasSubstr("CLK made 0 rising edges")));
  EXPECT_TRUE(only(world->stopped.changes, Pin::kLReq).empty());
}

TEST(Clock, CycleNIsTheNthRisingEdge) {
  const Changes rises = only(world->late.changes, Pin::kLReq);
  ASSERT_GE(rises.size(), 3U);
  ASSERT_GE(world->late_rises.size(), 2U);
  const dsdpv1::Tick first = rises[0].at / 250, second = rises[2].at / 250;
  EXPECT_EQ(world->late_rises[0], sc_time(21, sc_core::SC_NS) * static_cast<double>(first));
  EXPECT_EQ(world->late_rises[1], sc_time(21, sc_core::SC_NS) * static_cast<double>(second));
}

TEST(Clock, ASlowClkGivesTheSameCyclesAsARightOne) {
  const Changes late = only(world->late.changes, Pin::kLReq), unbound = only(world->unbound.changes, Pin::kLReq);
  ASSERT_GE(unbound.size(), late.size());
  EXPECT_EQ(late, Changes(unbound.begin(), unbound.begin() + static_cast<std::ptrdiff_t>(late.size())));
}

}  // namespace
}  // namespace dsdpv1
