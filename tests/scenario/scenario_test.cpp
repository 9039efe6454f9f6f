// Scenarios: what is read, and what comes from the same description.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/input/input_error.hpp"
#include "kinds/dsdpv1/keys/settings.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1 {
namespace {

namespace sc = tb::scenario;

const std::string kSmall =
    "name: small\nbaud: 1.5M\nend: 10ms\n"
    "slaves:\n  - {name: demo, address: 5, init: {ident: 0x1234, max_inputs: 2, max_outputs: 2, cfg: \"31\"}}\n";

TEST(Scenario, HoldsWhatTheFileSays) {
  const sc::Scenario scenario =
      sc::parse(kSmall +
                    "masters:\n  - name: plc\n    start: 1ms\n    slaves:\n      - {slave: demo, watchdog: 100ms, "
                    "groups: [1, 3]}\n"
                    "script:\n  - {at: 2ms, do: set_outputs, slave: demo, bytes: \"01 02\"}\n"
                    "  - {when: {slave: demo, dp_state: data_exch, after: 1us}, do: global_control, sync: true}\n"
                    "expect:\n  - {slave: demo, data_exchanges: 10, by: 9ms}\n"
                    "allow:\n  - {event: HOST_TS}\n",
                "s.yaml");
  EXPECT_EQ(scenario.name, "small");
  EXPECT_EQ(scenario.baud, 3);
  EXPECT_EQ(scenario.end, 10 * bus::kTicksPerMs);
  ASSERT_EQ(scenario.slaves.size(), 1U);
  EXPECT_EQ(scenario.slaves[0].init.ident, 0x1234);
  EXPECT_EQ(scenario.slaves[0].init.cfg, bus::Bytes{0x31});
  ASSERT_EQ(scenario.masters.size(), 1U);
  EXPECT_EQ(scenario.masters[0].slaves.at(0).groups, (bus::Bytes{1, 3}));
  ASSERT_EQ(scenario.script.size(), 2U);
  EXPECT_EQ(scenario.script[0].what, sc::ActionKind::kSetOutputs);
  EXPECT_EQ(scenario.script[1].when->after, bus::kTicksPerUs);
  EXPECT_TRUE(scenario.script[1].sync);
  EXPECT_EQ(scenario.expect.at(0).data_exchanges, 10);
  EXPECT_EQ(scenario.expect[0].by, 9 * bus::kTicksPerMs);
  EXPECT_EQ(scenario.allow.at(0).event.line, 17);
}

TEST(Scenario, LeavesDefaultsWhereKeysAreMissing) {
  const sc::Scenario scenario = sc::parse(kSmall, "s.yaml");
  EXPECT_EQ(static_cast<const tb::Dsdpv1Settings&>(*scenario.chip).access_interval, dsdpv1::Config{}.access_interval);
  EXPECT_EQ(tb::own(scenario.slaves[0].user_cpu).kind, tb::CpuKind::kNative);
  EXPECT_EQ(scenario.slaves[0].user_cpu.judge_delay, 0);
  EXPECT_FALSE(tb::own(scenario.slaves[0].user_cpu).access);
}

TEST(Scenario, OutputsOfAMasterAreBytesOrAWord) {
  const auto slave_with = [](const std::string& keys) {
    const std::string masters = "masters: [{name: plc, slaves: [{slave: demo, " + keys + "}]}]\n";
    return sc::parse(kSmall + masters, "s.yaml").masters.at(0).slaves.at(0);
  };
  EXPECT_EQ(slave_with("outputs: \"01 02\"").outputs, (bus::Bytes{1, 2}));
  EXPECT_EQ(slave_with("outputs: [1, 2]").pattern, bus::OutputPattern::kFixed);
  EXPECT_EQ(slave_with("outputs: count").pattern, bus::OutputPattern::kCount);
  const sc::MasterSlave random = slave_with("outputs: random, seed: 7");
  EXPECT_EQ(random.pattern, bus::OutputPattern::kRandom);
  EXPECT_EQ(random.seed, 7U);
  EXPECT_TRUE(random.outputs.empty());
}

std::string error_of_scenario(const std::string& text) {
  try {
    sc::parse(text, "s.yaml");
  } catch (const tb::InputError& error) {
    return error.what();
  }
  return "none";
}

// ------------------------------------------------------------------------------------------- a chip of a slave's own

/// A DSDPV1-RSU over SPI as the scenario's chip, `demo` with it and `other` with a DSDPV1.
std::string two_chips(const std::string& rest = "", const std::string& user = "{}") {
  return "name: two\nbaud: 1.5M\nend: 10ms\n"
         "chip: {kind: dsdpv1_rsu, mode: spi, rts_lead: 8}\n"
         "slaves:\n"
         "  - {name: demo, address: 5, init: {ident: 1, max_inputs: 2, max_outputs: 2, cfg: \"31\"},\n"
         "     user_cpu: {spi: {clock: 9000}}}\n"
         "  - {name: other, address: 6, init: {ident: 1, max_inputs: 2, max_outputs: 2, cfg: \"31\"},\n"
         "     chip: {kind: dsdpv1, intr_gap: 99}, user_cpu: " +
         user + "}\n" + rest;
}

const tb::Dsdpv1Settings& chip_of(const sc::Slave& slave) {
  return static_cast<const tb::Dsdpv1Settings&>(*slave.chip);
}

TEST(ChipOfASlave, ReplacesTheScenariosAsAWhole) {
  const sc::Scenario scenario = sc::parse(two_chips(), "s.yaml");
  const sc::Slave &demo = scenario.slaves[0], &other = scenario.slaves[1];
  EXPECT_EQ(demo.kind, scenario.kind);
  EXPECT_EQ(demo.chip, scenario.chip);
  EXPECT_EQ(chip_of(demo).rts_lead, 8);
  EXPECT_STREQ(other.kind->name(), "dsdpv1");
  EXPECT_EQ(chip_of(other).rts_lead, dsdpv1::Config{}.rts_lead);
  EXPECT_EQ(chip_of(other).intr_gap, 99);
  EXPECT_EQ(sc::kinds(scenario), (tb::ChipKinds{demo.kind, other.kind}));
}

TEST(ChipOfASlave, WithoutAKindIsOneOfTheScenarios) {
  const sc::Scenario scenario = sc::parse(
      two_chips(), "s.yaml", sc::parse_settings({"slaves.demo.chip.rts_trail=3", "slaves.demo.chip.mode=spi"}));
  EXPECT_EQ(scenario.slaves[0].kind, scenario.kind);
  EXPECT_EQ(chip_of(scenario.slaves[0]).rts_trail, 3);
  EXPECT_EQ(chip_of(scenario.slaves[0]).rts_lead, dsdpv1::Config{}.rts_lead);
}

TEST(ChipOfASlave, DecidesWhichKeysItsUserCpuHas) {
  EXPECT_EQ(error_of_scenario(two_chips("", "{spi: {clock: 9000}}")).substr(0, 37),
            "s.yaml:9: unknown key spi in user_cpu");
  EXPECT_EQ(error_of_scenario(two_chips("", "{fsmc: {datast: 3}}")), "none");
}

TEST(ChipOfASlave, IsReachedFromTheCommandLine) {
  const auto with = [](const std::string& setting) {
    return sc::parse(two_chips(), "s.yaml", sc::parse_settings({setting})).slaves[1];
  };
  EXPECT_EQ(chip_of(with("slaves.other.chip.intr_gap=70")).intr_gap, 70);
  EXPECT_EQ(with("slaves.1.user_cpu.fsmc.datast=3").user_cpu.given.size(), 1U);
  EXPECT_STREQ(with("slaves.other.chip.kind=dsdpv1_r").kind->name(), "dsdpv1_r");
  EXPECT_THROW(with("slaves.other.user_cpu.spi.clock=9000"), tb::InputError);
}

TEST(ChipOfASlave, TakesOnlyActionsOfItsKind) {
  EXPECT_EQ(error_of_scenario(two_chips("script: [{at: 1ms, do: flip_bit, slave: demo}]\n")), "none");
  EXPECT_EQ(error_of_scenario(two_chips("script: [{at: 1ms, do: flip_bit, slave: other}]\n")),
            "s.yaml:10: slave other is a DSDPV1, expected a slave of a kind with flip_bit");
}

TEST(ChipOfASlave, HasItsKindsLimits) {
  const sc::Scenario scenario = sc::parse(two_chips("checks: {TIMING_TS: {min: 15ns}}\n"), "s.yaml");
  const auto ts = [&](const sc::Slave& slave) {
    const checks::RuleTable& rules = slave.kind->rules();
    std::size_t i = 0;
    while (std::string(rules.at(i).id) != "TIMING_TS") ++i;
    return sc::limits_of(scenario, *slave.kind)[checks::CheckId(i)].value;
  };
  EXPECT_EQ(ts(scenario.slaves[0]), 15 * bus::kTicksPerNs);
  EXPECT_NE(ts(scenario.slaves[1]), 15 * bus::kTicksPerNs);
}

TEST(ChipOfASlave, IsRefusedWhereOneChipIsWanted) {
  EXPECT_NO_THROW(sc::check_one_chip(sc::parse(kSmall, "s.yaml"), "RTL"));
  try {
    sc::check_one_chip(sc::parse(two_chips(), "s.yaml"), "RTL");
    FAIL();
  } catch (const tb::InputError& error) {
    EXPECT_STREQ(error.what(),
                 "s.yaml:8: slave other has a chip of its own, expected one chip for all slaves: RTL takes no other");
  }
}

TEST(ChipOfASlave, OfAnUnknownKindIsRefused) {
  try {
    sc::parse(two_chips(), "s.yaml", sc::parse_settings({"slaves.other.chip.kind=dsdpv"}));
    FAIL();
  } catch (const tb::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("kind is \"dsdpv\" (did you mean dsdpv1?)"), std::string::npos)
        << error.what();
  }
}

TEST(Scenario, WhatBeginsWithACommaIsRefusedAtOnce) {
  EXPECT_EQ(error_of_scenario(","), "s.yaml:1: is empty, expected a scenario");
  EXPECT_EQ(error_of_scenario(kSmall + ",\n").rfind("s.yaml:", 0), 0U);
}

TEST(Scenario, ASecondDocumentIsNamedByItsLine) {
  EXPECT_EQ(error_of_scenario(kSmall + "---\nname: more\n"),
            "s.yaml:7: a second document, expected one scenario a file");
}

TEST(Scenario, PathsAreRelativeToItsFolder) {
  sc::Scenario scenario = sc::parse(kSmall, "some/where/s.yaml");
  EXPECT_EQ(sc::resolve(scenario, {"../x.gsd", 1}), "some/x.gsd");
  scenario.file = "s.yaml";
  EXPECT_EQ(sc::resolve(scenario, {"x.gsd", 1}), "x.gsd");
}

TEST(JsonSchema, IsJsonAndKnowsEveryKeyOfTheDescription) {
  const auto definitions = nlohmann::json::parse(sc::json_schema())["$defs"];
  for (const tb::ChipKind* kind : tb::chip_kinds()) {
    const std::string prefix = kind == tb::chip_kinds().front() ? "" : std::string(kind->name()) + ".";
    auto scenario = definitions[prefix + "scenario"], actions = definitions[prefix + "action"]["oneOf"];
    for (const auto& field : sc::description(*kind).fields)
      EXPECT_TRUE(scenario["properties"].contains(field.name)) << field.name;
    EXPECT_FALSE(scenario["additionalProperties"]);
    EXPECT_EQ(scenario["required"], (nlohmann::json{"name", "baud", "end", "slaves"}));
    EXPECT_EQ(actions.size(), sc::description(*kind).find("script")->type.object->choices.size());
  }
}

TEST(Markdown, IsTheCheckedInFile) {
  std::ifstream in(DSDPV1_SOURCE_DIR "/docs/scenarios.md");
  std::ostringstream text;
  text << in.rdbuf();
  EXPECT_TRUE(text.str() == sc::markdown(*tb::chip_kinds().front()))
      << "docs/scenarios.md is stale: dsdpv1-sim schema --markdown > docs/scenarios.md";
}

}  // namespace
}  // namespace dsdpv1
