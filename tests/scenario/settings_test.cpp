// Keys of a scenario replaced from the command line: which key a path means, and what is wrong with a path or value.
#include "tb/scenario/settings.hpp"

#include <gtest/gtest.h>

#include "io/input/input_error.hpp"
#include "kinds/dsdpv1/keys/settings.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1 {
namespace {

using tb::scenario::Scenario;

const std::string kScenario =
    "name: x\nbaud: 12M\nend: 10ms\n"
    "slaves:\n"
    "  - {name: first, address: 5, init: {ident: 1, max_inputs: 1, max_outputs: 1, cfg: \"30\"}}\n"
    "  - {name: second, address: 6, init: {ident: 1, max_inputs: 1, max_outputs: 1, cfg: \"30\"}, user_cpu: {cycle: "
    "70us}}\n"
    "masters: [{name: plc, slaves: [{slave: first}]}]\n";

Scenario with(const std::vector<std::string>& texts) {
  return tb::scenario::parse(kScenario, "s.yaml", tb::scenario::parse_settings(texts));
}

std::string error_of(const std::string& text) {
  try {
    with({text});
  } catch (const tb::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Settings, ReplaceAKeyOfTheScenario) { EXPECT_EQ(with({"end=20ms"}).end, 20 * bus::kTicksPerMs); }

TEST(Settings, ReachAnItemByNumberAndByName) {
  EXPECT_EQ(with({"slaves.0.address=7"}).slaves[0].address, 7);
  EXPECT_EQ(with({"slaves.second.address=7"}).slaves[1].address, 7);
  EXPECT_EQ(with({"slaves.second.address=7"}).slaves[0].address, 5);
  EXPECT_EQ(with({"masters.plc.slaves.0.watchdog=10ms"}).masters[0].slaves[0].watchdog, 10 * bus::kTicksPerMs);
}

TEST(Settings, BeginningWithAKeyOfASlaveMeanEverySlave) {
  const Scenario scenario = with({"user_cpu.cycle=40us", "user_cpu.fsmc.datast=3"});
  for (const tb::scenario::Slave& slave : scenario.slaves) {
    EXPECT_EQ(slave.user_cpu.cycle, 40 * bus::kTicksPerUs);
    ASSERT_TRUE(tb::own(slave.user_cpu).fsmc);
    EXPECT_EQ(tb::own(slave.user_cpu).fsmc->datast, 3);
    EXPECT_FALSE(tb::own(slave.user_cpu).fsmc->addset);
  }
}

TEST(Settings, LaterOnesWinAndOtherKeysStay) {
  const Scenario scenario = with({"slaves.1.user_cpu.start_delay=1us", "slaves.1.user_cpu.start_delay=2us"});
  EXPECT_EQ(scenario.slaves[1].user_cpu.start_delay, 2 * bus::kTicksPerUs);
  EXPECT_EQ(scenario.slaves[1].user_cpu.cycle, 70 * bus::kTicksPerUs);
}

TEST(Settings, TakeBytesAsHexadecimalTextOrAsAList) {
  EXPECT_EQ(with({"init.cfg=31"}).slaves[0].init.cfg, (bus::Bytes{0x31}));
  EXPECT_EQ(with({"init.cfg=13 23"}).slaves[0].init.cfg, (bus::Bytes{0x13, 0x23}));
  EXPECT_EQ(with({"init.cfg=[49]"}).slaves[0].init.cfg, (bus::Bytes{0x31}));
}

TEST(Settings, WrongPathIsNamedWithTheNearestKey) {
  EXPECT_EQ(error_of("user_cpu.cicle=1us").substr(0, 73),
            "--set user_cpu.cicle=1us: unknown key cicle in user_cpu (did you mean cyc");
  const std::string error = error_of("usercpu.cycle=1us");
  EXPECT_EQ(error.substr(0, error.find(", expected")),
            "--set usercpu.cycle=1us: unknown key usercpu in scenario (did you mean user_cpu?)");
  EXPECT_NE(error.find("; of every slave name, address,"), std::string::npos) << error;
  EXPECT_EQ(error_of("slaves.third.address=1"),
            "--set slaves.third.address=1: slaves has no item third, expected 0 to 1, first, second");
  EXPECT_EQ(error_of("script.0.at=1us"), "--set script.0.at=1us: the scenario has no script");
}

TEST(Settings, PathMustEndAtOneValue) {
  EXPECT_EQ(error_of("user_cpu.fsmc=1"),
            "--set user_cpu.fsmc=1: fsmc is a mapping, expected its keys addset, datast, busturn, hclk, mode");
  EXPECT_EQ(error_of("slaves=1"),
            "--set slaves=1: slaves is a list, expected the keys of one item, like slaves.0.name");
  EXPECT_EQ(error_of("slaves.0=1"),
            "--set slaves.0=1: slaves is a list, expected the keys of one item, like slaves.0.name");
  EXPECT_EQ(error_of("end.long=1"), "--set end.long=1: end is one value, expected no key long below it");
}

TEST(Settings, WrongValueTellsWhatIsAllowed) {
  EXPECT_EQ(error_of("user_cpu.fsmc.datast=256"),
            "--set user_cpu.fsmc.datast=256: datast is \"256\", expected a whole number from 0 to 255 HCLK");
  EXPECT_EQ(error_of("end=5"),
            "--set end=5: end is \"5\", expected a number with a unit ns, us, ms, s or cycles, like 1.5ms");
  EXPECT_EQ(error_of("user_cpu.fsmc.mode=B"), "--set user_cpu.fsmc.mode=B: mode is \"B\", expected 1, A");
  EXPECT_EQ(error_of("init.cfg=[1, x"), "--set init.cfg=[1, x: [1, x is no list, expected something like [1, 2]");
}

TEST(Settings, NeedAPathAndAnEqualsSign) {
  EXPECT_EQ(error_of("end"), "--set end: expected PATH=VALUE, like user_cpu.cycle=40us");
  EXPECT_EQ(error_of("=1"), "--set =1: expected PATH=VALUE, like user_cpu.cycle=40us");
}

TEST(Settings, WhatTheyMakeOfTheScenarioIsCheckedLikeTheFile) {
  EXPECT_EQ(error_of("masters.0.slaves.0.slave=third"), "s.yaml:7: slave third does not exist, expected first, second");
}

TEST(Settings, BusTimesAndFsmcRegistersTogetherAreRefused) {
  EXPECT_EQ(tb::scenario::field_of_any("user_cpu.fsmc.datast", "").name, "datast");
  std::string text = kScenario;
  text.replace(text.find("cycle: 70us"), 11, "fsmc: {addset: 2}");
  const std::vector<tb::scenario::Setting> settings = {
      tb::scenario::parse_setting("--set", "slaves.1.user_cpu.access.rd_low=50ns")};
  try {
    tb::scenario::parse(text, "s.yaml", settings);
    FAIL() << "no error";
  } catch (const tb::InputError& error) {
    EXPECT_STREQ(error.what(), "s.yaml:6: user_cpu has 2 of access, fsmc, expected one at most");
  }
}

}  // namespace
}  // namespace dsdpv1
