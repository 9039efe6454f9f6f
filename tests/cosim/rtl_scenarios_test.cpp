// Every shipped scenario on the reference RTL: the short ones with their golden trace and the log of the model, the
// long ones, whose traces cost minutes, in lockstep, which compares each of their cycles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <random>
#include <vector>

#include "cosim/rtl.hpp"
#include "tb/scenario/scenario.hpp"
#include "tests/app/program.hpp"

namespace dsdpv1 {
namespace {

namespace fs = std::filesystem;
using app_test::call;
using app_test::read;
using app_test::shipped_scenarios;

std::vector<std::string> scenarios(bool long_ones) {
  constexpr bus::Tick kLongest = 120 * bus::kTicksPerMs;
  std::vector<std::string> names = shipped_scenarios();
  const auto is_other = [long_ones](const std::string& name) {
    const tb::scenario::Scenario scenario = tb::scenario::load(DSDPV1_SOURCE_DIR "/scenarios/" + name + ".yaml");
    return !has_rtl(scenario) || (scenario.end > kLongest) != long_ones;
  };
  names.erase(std::remove_if(names.begin(), names.end(), is_other), names.end());
  return names;
}

class RtlScenarios : public testing::TestWithParam<std::string> {
 protected:
  app_test::Called run(const std::string& arguments) const {
    return call("run scenarios/" + GetParam() + ".yaml --no-progress " + arguments, DSDPV1_SOURCE_DIR);
  }
  std::string logged(const std::string& engine) const {
    return "--checks fail --engine " + engine + " --log '" + folder_.file(engine + ".log") + "'";
  }
  app_test::Folder folder_;
};

class LongRtlScenarios : public RtlScenarios {};
class ShortRtlScenarios : public RtlScenarios {};

TEST_P(LongRtlScenarios, ModelAndRtlDoNotDiffer) {
  const app_test::Called called = run("--engine lockstep --difference '" + folder_.file("difference.vcd") +
                                      "' --log '" + folder_.file("log") + "'");
  EXPECT_EQ(called.status, 0) << called.out << called.err;
  EXPECT_THAT(called.out, testing::HasSubstr("of model and RTL are the same"));
  EXPECT_FALSE(fs::exists(folder_.file("difference.vcd")));
}

TEST_P(ShortRtlScenarios, PinsOfTheRtlAreTheGoldenAndItsLogIsThatOfTheModel) {
  ASSERT_EQ(run(logged("skip")).status, 0);
  const app_test::Called rtl = run(logged("rtl") + " --golden traces");
  ASSERT_EQ(rtl.status, 0) << rtl.out << rtl.err;
  EXPECT_TRUE(read(folder_.file("skip.log")) == read(folder_.file("rtl.log")));
}

/// Not varied by random cases and scenarios: when the transmitter's driver is on around an answer. Several RTLs in one
/// thread, as in a scenario with several slaves.
TEST(ReferenceRtl, GoesInAnyOrder) {
  std::mt19937 random(1);
  for (int round = 0; round < 50; ++round) {
    std::vector<std::unique_ptr<cosim::Rtl>> all;
    for (const char* name : {"dsdpv1", "dsdpv1_rsu", "dsdpv1", "dsdpv1"}) {
      const tb::ChipKind& kind = *tb::find_chip_kind(name);
      all.push_back(kind.rtl()->make_reference(*kind.make_chip_settings(), 0, cosim::kUsualSeed));
    }
    std::vector<std::string> rubbish;
    std::shuffle(all.begin(), all.end(), random);
    for (std::unique_ptr<cosim::Rtl>& each : all) {
      std::array<tb::Level, tb::kMostPins> levels{};
      each->eval(false, levels.data());
      each.reset();
      for (std::size_t size = 32; size < 8192; size += 8) rubbish.emplace_back(size, '\xFF');  // where it was
    }
  }
}

TEST(RtlLimits, OfTheTransmitterAreThoseOfTheModel) {
  for (const std::string limits :
       {"--set chip.rts_lead=0 --set chip.rts_trail=32", "--set chip.rts_lead=32 --set chip.rts_trail=0"}) {
    const app_test::Folder folder;
    const app_test::Called called = call("run scenarios/bus_timing.yaml --no-progress --engine lockstep " + limits +
                                             " --difference '" + folder.file("difference.vcd") + "'",
                                         DSDPV1_SOURCE_DIR);
    EXPECT_EQ(called.status, 0) << limits << "\n" << called.out << called.err;
    EXPECT_THAT(called.out, testing::HasSubstr("of model and RTL are the same")) << limits;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, LongRtlScenarios, testing::ValuesIn(scenarios(true)), [](const auto& each) { return each.param; });
INSTANTIATE_TEST_SUITE_P(All, ShortRtlScenarios, testing::ValuesIn(scenarios(false)),
                         [](const auto& each) { return each.param; });

}  // namespace
}  // namespace dsdpv1
