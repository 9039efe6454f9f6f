// The masters of a scenario on the caller's bus.
#include <gmock/gmock.h>

#include <string>

#include "tests/capi/station.hpp"

namespace dsdpv1::capi_test {
namespace {

const std::string kSlaves =
    "name: test\n"
    "baud: 12M\n"
    "end: 1ms\n"
    "slaves:\n"
    "  - {name: io, address: 5, init: {ident: 0x0CC9, max_inputs: 4, max_outputs: 4, cfg: \"33\"}}\n";

/// `script`: lines of YAML. The caller is the slave's user side: the scenario's part for it is ignored.
std::string scenario_with(const std::string& script, const std::string& masters2 = "") {
  std::string text =
      kSlaves +
      "masters:\n"
      "  - {name: plc, address: 2, start: 500us, bus: {ring: true, highest_address: 6}, slaves: [{slave: io, outputs: "
      "\"01 02 03 04\"}]}\n";
  if (!masters2.empty()) text += "masters2:\n  - " + masters2 + "\n";
  return text + "script:\n" + script;
}

struct Told {
  std::vector<std::string> replies;
  static void note(void* user, const dpsim_event* event) {
    const bool done = event->type == DPSIM_EVENT_REQUEST_DONE || event->type == DPSIM_EVENT_ACYCLIC_DONE;
    if (done && event->id == 0) static_cast<Told*>(user)->replies.emplace_back(event->text);
  }
};

struct Added {
  dpsim_status status = DPSIM_OK;
  std::vector<dpsim_master*> masters;
  std::string left_out;
};

Added add(dpsim_bus* bus, const std::string& text, std::size_t capacity = 4) {
  auto options = sized<dpsim_scenario_options>();
  options.path = "test.yaml";
  options.text = text.c_str();
  Added added;
  added.masters.resize(capacity);
  std::size_t count = 0;
  const char* left_out = "";
  added.status = dpsim_bus_add_scenario(bus, &options, added.masters.data(), capacity, &count, &left_out);
  added.masters.resize(count);
  added.left_out = left_out;
  return added;
}

TEST(CapiScenario, ItsMastersStartAndCarryOutTheScriptByThemselves) {
  const auto bus = make_bus();
  dpsim_chip* chip = add_chip(bus.get());
  Told told;
  ok(dpsim_bus_on_event(bus.get(), Told::note, &told));
  const Added added = add(
      bus.get(),
      scenario_with(
          "  - {when: {slave: io, data_exchanges: 20}, do: set_outputs, slave: io, bytes: \"0A 0B 0C 0D\"}\n"
          "  - {at: 900us, do: pause_user, slave: io, for: 1us}\n"
          "  - {when: {slave: io, dp_state: data_exch, after: 1ms}, do: get_cfg, slave: io}\n"
          "  - {when: {reply_of: get_cfg, reply: \"33\"}, do: c1_read, slave: io, slot: 1, index: 1, length: 4}\n"));
  ok(added.status);
  ASSERT_EQ(added.masters.size(), 1U);
  EXPECT_EQ(
      added.left_out,
      "test.yaml: left out are slaves, chip, checks, expect, allow and end; of the script, by line: pause_user (10)");
  start_up(chip);
  ok(dpsim_bus_run(bus.get(), 10 * kMs));

  auto slave = sized<dpsim_slave_status>();
  ok(dpsim_master_get_slave(added.masters[0], 5, &slave));
  EXPECT_EQ(slave.state, DPSIM_SLAVE_DATA_EXCHANGE) << slave.reason;
  uint8_t cell = 0;
  ok(dpsim_chip_peek(chip, dsdpv1::regs::kOutput + 1, &cell));
  EXPECT_EQ(cell, 0x0A);
  EXPECT_THAT(told.replies, testing::ElementsAre("get_cfg: 33", "c1_read: refused"));
}

TEST(CapiScenario, MastersOfBothClassesShareTheBus) {
  const auto bus = make_bus();
  dpsim_chip* chip = add_chip(bus.get());
  const Added added = add(
      bus.get(),
      scenario_with("  - {when: {slave: io, dp_state: data_exch}, do: c2_connect, connection: eng_io}\n",
                    "{name: eng, address: 3, bus: {highest_address: 6}, connections: [{name: eng_io, slave: io}]}"));
  ok(added.status);
  ASSERT_EQ(added.masters.size(), 2U);
  std::vector<std::string> ends;
  ok(dpsim_bus_on_event(
      bus.get(),
      [](void* user, const dpsim_event* event) {
        if (event->type == DPSIM_EVENT_CONNECTION_END)
          static_cast<std::vector<std::string>*>(user)->emplace_back(event->text);
      },
      &ends));
  start_up(chip);
  ok(dpsim_bus_run(bus.get(), 20 * kMs));
  EXPECT_EQ(ends.size(), 1U) << "its user has not switched DPV1 on";
}

void expect_refused(const std::string& text, dpsim_status status, const std::string& message) {
  const auto bus = make_bus();
  EXPECT_EQ(add(bus.get(), text, 1).status, status);
  EXPECT_EQ(dpsim_error_message(), message);
  uint16_t station = 99;
  ok(dpsim_bus_add_station(bus.get(), nullptr, &station));
  EXPECT_EQ(station, 0) << "somebody is on the bus";
}

TEST(CapiScenario, WhatMastersCannotKnowOrDoIsRefusedInOneLine) {
  const std::string allowed =
      " is not known to masters whose slaves are elsewhere, expected dp_state data_exch, data_exchanges and inputs "
      "of a "
      "slave that a master of class 1 brings up, connection_state, reply_of";
  const auto when = [](const std::string& condition) {
    return scenario_with("  - {when: {slave: io, " + condition + "}, do: clear}\n");
  };
  expect_refused(when("event: DIAG"), DPSIM_ERR_INPUT, "test.yaml:9: when: event DIAG" + allowed);
  expect_refused(when("dp_state: wait_prm"), DPSIM_ERR_INPUT, "test.yaml:9: when: dp_state WAIT_PRM" + allowed);
  expect_refused(when("outputs: \"00\""), DPSIM_ERR_INPUT, "test.yaml:9: when: outputs" + allowed);
  expect_refused(kSlaves, DPSIM_ERR_INPUT,
                 "test.yaml:1: the scenario has no masters, expected one with masters or masters2");
  expect_refused(scenario_with("  - {at: 1us, do: clear}\n", "{name: eng, address: 3}"), DPSIM_ERR_SPACE,
                 "dpsim_bus_add_scenario: the scenario has 2 masters, capacity is 1");
}

TEST(CapiScenario, AMissingGsdLeavesNobodyOnTheBus) {
  expect_refused(kSlaves + "masters:\n  - {name: plc, slaves: [{address: 6, gsd: none.gsd}]}\n", DPSIM_ERR_INPUT,
                 "test.yaml:7: gsd none.gsd: no such file, expected a GSD file, its path relative to the scenario");
}

}  // namespace
}  // namespace dsdpv1::capi_test
