// The data for user CPUs and masters, derived from the scenario and its GSD.
#include <gtest/gtest.h>

#include "io/input/input_error.hpp"
#include "tb/bench/setup.hpp"

namespace dsdpv1 {
namespace {

const std::string kFile = DSDPV1_SOURCE_DIR "/scenarios/test.yaml";

tb::scenario::Scenario parse(const std::string& slave, const std::string& master_slave) {
  return tb::scenario::parse("name: x\nbaud: 12M\nend: 1ms\nslaves:\n  - {name: demo, address: 5, " + slave +
                                 "}\nmasters:\n  - {name: plc, slaves: [{" + master_slave + "}]}\n",
                             kFile);
}

TEST(Setup, StationFollowsTheGsdAndItsModules) {
  const auto scenario = parse(R"(gsd: dsdpv1.gsd, modules: ["8 bytes in", "2 words out"])", "slave: demo");
  const auto station = tb::Setup(scenario).station(scenario.slaves[0]);
  EXPECT_EQ(station.address, 5);
  EXPECT_EQ(station.ident, 0x0CC9);
  EXPECT_EQ(station.cfg, (bus::Bytes{0x17, 0x61}));
  EXPECT_EQ(station.max_input, 244);
  EXPECT_EQ(station.max_diag, 238);
  EXPECT_EQ(station.max_cfg, 200) << "the chip's, the GSD does not say it";
  EXPECT_TRUE(station.sync);
  EXPECT_EQ(station.max_prm, 237) << "mode 0: at most so many";
  const auto exact = parse(R"(gsd: dsdpv1.gsd, modules: ["2 words in, filtered"], init: {prm_mode: 1})", "slave: demo");
  EXPECT_EQ(tb::Setup(exact).station(exact.slaves[0]).max_prm, 3 + 2) << "mode 1: what the GSD has for both parts";
}

TEST(Setup, InitOverridesTheGsd) {
  const auto scenario = parse(
      "gsd: dsdpv1.gsd, init: {max_inputs: 8, max_cfg: 3, sync: false, ident: 0x1234, cfg: \"30\"}", "slave: demo");
  const auto station = tb::Setup(scenario).station(scenario.slaves[0]);
  EXPECT_EQ(station.max_input, 8);
  EXPECT_EQ(station.max_cfg, 3);
  EXPECT_FALSE(station.sync);
  EXPECT_EQ(station.ident, 0x1234);
  EXPECT_EQ(station.cfg, bus::Bytes{0x30});
}

TEST(Setup, Dpv1FollowsTheGsdsSlaveAndItsEnable) {
  const auto dpv1 = [](const std::string& slave) {
    const auto scenario = parse(slave, "slave: demo");
    return tb::Setup(scenario).station(scenario.slaves[0]).dpv1;
  };
  EXPECT_FALSE(dpv1("gsd: dsdpv1.gsd, modules: [\"1 byte in\"]")) << "its DPV1_Enable is 0";
  EXPECT_TRUE(dpv1("gsd: ../tests/gsd/samples/rev3_slots.gsd"));
  EXPECT_FALSE(dpv1("gsd: ../tests/gsd/samples/rev3_slots.gsd, init: {dpv1: false}"));
  EXPECT_TRUE(dpv1("gsd: dsdpv1.gsd, modules: [\"1 byte in\"], init: {dpv1: true}"));
}

TEST(Setup, MasterTakesTheModulesOfItsSlave) {
  const auto scenario = parse(R"(gsd: dsdpv1.gsd, modules: ["2 bytes in", "4 bytes out"])",
                              "slave: demo, groups: [1, 3], watchdog: 100ms");
  tb::Setup setup(scenario);
  const auto parameters = setup.parameters(scenario.masters[0].slaves[0]);
  EXPECT_EQ(parameters.address, 5);
  EXPECT_EQ(parameters.cfg, (bus::Bytes{0x11, 0x23}));
  EXPECT_EQ(parameters.input_length, 2);
  EXPECT_EQ(parameters.output_length, 4);
  EXPECT_EQ(parameters.group_ident, 0x05);
  EXPECT_EQ(parameters.wd_fact_1 * parameters.wd_fact_2, 10);
  EXPECT_EQ(parameters.min_slave_interval_us, 600) << "6 units of 100 us";
}

TEST(Setup, UnknownModuleIsAnInputErrorAtItsLine) {
  const auto scenario = parse("gsd: dsdpv1.gsd, modules: [\"9 bytes in\"]", "slave: demo");
  try {
    tb::Setup(scenario).station(scenario.slaves[0]);
    FAIL();
  } catch (const tb::InputError& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, kFile.size() + 3), kFile + ":5:");
  }
}

TEST(WatchdogFactors, GiveTheLeastTimeThatIsNotShorter) {
  for (const int ms : {10, 20, 100, 250, 2570, 10'000, 650'250}) {
    const tb::Watchdog w = tb::watchdog_factors(ms * bus::kTicksPerMs);
    const int time = w.fact_1 * w.fact_2 * (w.base_1ms ? 1 : 10);
    EXPECT_GE(time, ms);
    EXPECT_LE(time, ms + ms / 100 + 10);
  }
  EXPECT_TRUE(tb::watchdog_factors(3 * bus::kTicksPerMs).base_1ms);
  EXPECT_EQ(tb::watchdog_factors(0).fact_1, 0);
}

}  // namespace
}  // namespace dsdpv1
