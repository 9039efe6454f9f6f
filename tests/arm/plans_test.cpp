// The board among the others of the bench: what it plans to do, which edges at its serial pins move, is announced.
#include <gtest/gtest.h>

#include <utility>

#include "tb/bench/bench.hpp"
#include "tb/dsdpv1/board/arm_user.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1 {
namespace {

TEST(BoardPlans, AreAnnouncedWhenPeripheralsAndChipMoveThem) {
  tb::add_arm_board();
  for (const char* name : {"arm_spi", "arm_uart"}) {
    tb::scenario::Scenario scenario = tb::scenario::load(std::string(DSDPV1_SOURCE_DIR "/scenarios/") + name + ".yaml");
    scenario.end = 30 * bus::kTicksPerMs;
    auto execution = tb::make_pin_execution();
    execution->timeline().check_announcements();
    tb::Bench bench(scenario, {}, std::move(execution));
    const tb::RunResult result = bench.run([](tb::Tick) { return true; });
    EXPECT_GE(result.slaves.at(0).status.data_exchanges, 1U) << name;
  }
}

}  // namespace
}  // namespace dsdpv1
