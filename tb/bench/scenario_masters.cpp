#include "tb/bench/scenario_masters.hpp"

#include <fmt/format.h>

#include <utility>

#include "io/input/input_error.hpp"

namespace dsdpv1::tb {
namespace {

using scenario::Action;
using scenario::ActionKind;
using scenario::Condition;
using scenario::Scenario;

bool is_of_masters(const Action& action) {
  return action.what >= ActionKind::kSetOutputs && action.what <= ActionKind::kC2Raw;
}

const scenario::Slave* find_slave(const Scenario& scenario, const std::string& name) {
  for (const scenario::Slave& each : scenario.slaves)
    if (each.name.text == name) return &each;
  return nullptr;
}

/// True if a class 1 master lists the slave.
bool is_listed(const Scenario& scenario, const std::string& slave) {
  for (const scenario::Master& master : scenario.masters)
    for (const scenario::MasterSlave& each : master.slaves)
      if (each.slave.text == slave) return true;
  return false;
}

/// The key of a condition that no master can evaluate; empty: all can be evaluated.
std::string untold(const Scenario& scenario, const Condition& c) {
  if (c.dp_state && *c.dp_state != profibus::DpState::kDataExch) return fmt::format("dp_state {}", name(*c.dp_state));
  if (c.baud) return "baud";
  if (c.station_address) return "station_address";
  if (c.outputs) return "outputs";
  if (!c.event.empty()) return "event " + c.event.text;
  if (c.tsdr_min || c.tsdr_max) return "tsdr_min, tsdr_max";
  if (c.longest_wait_at_most) return "longest_wait_at_most";
  const bool of_slave = c.dp_state || c.data_exchanges || c.data_exchanges_at_most || c.inputs;
  return of_slave && !is_listed(scenario, c.slave.text) ? "slave " + c.slave.text : "";
}

void check(const Scenario& scenario, const Action& action) {
  if (!action.when) return;
  if (const std::string key = untold(scenario, *action.when); !key.empty())
    throw InputError(scenario.file, action.when->line,
                     fmt::format("when: {} is not known to masters whose slaves are elsewhere, expected dp_state "
                                 "data_exch, data_exchanges and inputs of a slave that a master of class 1 brings up, "
                                 "connection_state, reply_of",
                                 key));
}

/// Fills in the values that the bench takes from the slave.
Action resolved(const Scenario& scenario, Setup& setup, Action action) {
  const scenario::Slave* slave = find_slave(scenario, action.slave.text);
  if (slave == nullptr) return action;
  const bool listed = is_listed(scenario, action.slave.text) && action.what != ActionKind::kSetSlaveAddress;
  if (!action.address && !listed) action.address = slave->address;
  if (action.what == ActionKind::kSetSlaveAddress && !action.ident) action.ident = setup.station(*slave).ident;
  return action;
}

Scenario part_of_masters(const Scenario& whole, Setup& setup) {
  if (whole.masters.empty() && whole.masters2.empty())
    throw InputError(whole.file, whole.line, "the scenario has no masters, expected one with masters or masters2");
  Scenario part = whole;
  part.slaves.clear();
  part.expect.clear();
  part.script.clear();
  for (const Action& action : whole.script) {
    if (!is_of_masters(action)) continue;
    check(whole, action);
    part.script.push_back(resolved(whole, setup, action));
  }
  for (scenario::Master2& master : part.masters2)
    for (scenario::Connection& connection : master.connections)
      if (const scenario::Slave* slave = find_slave(whole, connection.slave.text)) {
        connection.address = slave->address;
        connection.slave = {};
      }
  return part;
}

std::string words_left_out(const Scenario& whole) {
  std::string lines;
  for (const Action& action : whole.script)
    if (!is_of_masters(action)) lines += fmt::format("{}{} ({})", lines.empty() ? "" : ", ", action.word, action.line);
  return fmt::format("{}: left out are slaves, chip, checks, expect, allow and end{}{}", whole.file,
                     lines.empty() ? "" : "; of the script, by line: ", lines);
}

}  // namespace

ScenarioMasters::ScenarioMasters(Scenario scenario, bus::Segment& segment, const bus::Timeline& timeline)
    : whole_(std::move(scenario)),
      setup_(whole_),
      left_out_(words_left_out(whole_)),
      part_(part_of_masters(whole_, setup_)),
      observers_(timeline),
      journal_(part_, observers_, {}),
      script_(part_, stations_, segment, journal_, replies_, {}, observers_) {
  observers_.add(script_);
  for (const scenario::Master& master : part_.masters)
    stations_.masters.push_back(make_master(part_, master, setup_, segment));
  for (const scenario::Master2& master : part_.masters2)
    stations_.masters2.push_back(
        std::make_unique<Class2Station>(part_, master, stations_, segment, journal_, replies_, observers_));
  replies_.on_change = [this](const std::string& asker, ActionKind service, const Reply& reply) {
    observers_.changed();
    if (on_reply) on_reply(asker, service, reply);
  };
}

std::size_t ScenarioMasters::number_of(const std::string& asker) const {
  for (std::size_t i = 0; i < part_.masters.size(); ++i)
    if (part_.masters[i].name.text == asker) return i;
  for (std::size_t i = 0; i < stations_.masters2.size(); ++i)
    if (stations_.masters2[i]->has(asker)) return part_.masters.size() + i;
  return 0;
}

}  // namespace dsdpv1::tb
