#include "tb/bench/class2_station.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "io/input/input_error.hpp"
#include "io/input/units.hpp"
#include "tb/bench/journal.hpp"
#include "tb/bench/reply.hpp"
#include "tb/bench/stations.hpp"

namespace dsdpv1::tb {

using scenario::ActionKind;

namespace {

bus::MasterConfig config_of(const scenario::Master2& spec, int baud) {
  bus::MasterConfig config;
  config.name = spec.name.text;
  config.address = static_cast<std::uint8_t>(spec.address);
  config.baud = baud;
  config.bus = bus_parameters(spec.bus);
  return config;
}

}  // namespace

bus::BusParameters bus_parameters(const scenario::BusParameters& bus) {
  bus::BusParameters parameters;
  parameters.slot_bits = bus.slot_time;
  parameters.set_bits = bus.setup_time;
  parameters.quiet_bits = bus.quiet_time;
  parameters.max_retries = bus.retries;
  parameters.gap_factor = bus.gap_factor;
  parameters.highest_address = static_cast<std::uint8_t>(bus.highest_address);
  parameters.min_slave_interval_us = bus.min_slave_interval;
  parameters.token = bus.token;
  parameters.ring = bus.ring;
  parameters.target_rotation_bits = bus.target_rotation;
  parameters.clock_ppm = bus.clock_error;
  return parameters;
}

Class2Station::Class2Station(const scenario::Scenario& scenario, const scenario::Master2& spec, const Stations& slaves,
                             bus::Segment& segment, Journal& journal, Replies& replies, const Observers& observers)
    : journal_(journal),
      replies_(replies),
      observers_(observers),
      spec_(spec),
      master_(segment, config_of(spec, scenario.baud)) {
  for (const scenario::Connection& connection : spec.connections) add(scenario, connection, slaves);
  listen();
}

void Class2Station::add(const scenario::Scenario& scenario, const scenario::Connection& connection,
                        const Stations& slaves) {
  bus::ConnectionParameters parameters;
  parameters.slave = static_cast<std::uint8_t>(connection.address.value_or(
      connection.slave.empty() ? 0 : slaves.slave(connection.slave.text).station().address));
  parameters.send_timeout = static_cast<std::uint16_t>(connection.send_timeout);
  parameters.add_addr = connection.add_addr;
  parameters.poll_interval_us = connection.poll_interval / bus::kTicksPerUs;
  try {
    ids_[connection.name.text] = master_.add_connection(parameters);
  } catch (const std::invalid_argument& error) {
    throw InputError(scenario.file, connection.line, error.what());
  }
}

std::vector<std::string> Class2Station::connection_names() const {
  std::vector<std::string> names;
  for (const scenario::Connection& connection : spec_.connections) names.push_back(connection.name.text);
  return names;
}

void Class2Station::listen() {
  const auto connection = [this](bus::ConnectionId id) -> const std::string& {
    return spec_.connections[id].name.text;
  };
  master_.on_state = [this, connection](Tick at, bus::ConnectionId id, bus::ConnectionState from,
                                        bus::ConnectionState to) {
    journal_.log(at, name(), "state", fmt::format("{}: {} to {}", connection(id), bus::name(from), bus::name(to)));
    observers_.tell(&Observer::master_state, observers_.now(), name(), connection(id), std::string(bus::name(to)));
    observers_.changed();
  };
  master_.on_end = [this, connection](Tick at, bus::ConnectionId id, const bus::ConnectionEnd& end) {
    journal_.log(at, name(), "state", fmt::format("{} {}", connection(id), end.words));
  };
  master_.on_acyclic = [this, connection](Tick at, bus::ConnectionId id, const bus::AcyclicResult& result) {
    journal_.log(at, name(), "acyclic", fmt::format("{}: {}", connection(id), bus::describe(result)));
  };
}

void Class2Station::act(const scenario::Action& action, Tick now) {
  const bus::ConnectionId id = ids_.at(action.connection.text);
  const auto say = [&](const std::string& text) {
    journal_.log(now, name(), "script", fmt::format("{}: {}", action.connection.text, text));
  };
  switch (action.what) {
    case ActionKind::kC2Connect: say("connects"); return master_.connect(id);
    case ActionKind::kC2Abort: say("aborts"); return master_.abort(id);
    case ActionKind::kC2Behaviour: say("behaves otherwise"); return master_.set_behaviour(id, action.behaviour);
    case ActionKind::kC2Raw: {
      say("sends " + journal_.in_log(action.bytes));
      bus::RawAcyclic raw;
      raw.pdu = action.bytes;
      if (action.sap) raw.dsap = static_cast<std::uint8_t>(*action.sap);
      return master_.inject(id, std::move(raw));
    }
    default: return ask(action, id);
  }
}

void Class2Station::ask(const scenario::Action& action, bus::ConnectionId id) {
  const auto keep = [this, connection = action.connection.text, what = action.what](const bus::AcyclicResult& result) {
    replies_.keep(connection, what, reply_of(result));
  };
  if (connection(action.connection.text).state() == bus::ConnectionState::kClosed)
    return replies_.keep(action.connection.text, action.what, Reply{});
  const auto slot = static_cast<std::uint8_t>(action.slot), index = static_cast<std::uint8_t>(action.index);
  switch (action.what) {
    case ActionKind::kC2Read: return master_.read(id, slot, index, static_cast<std::uint8_t>(action.length), keep);
    case ActionKind::kC2Write: return master_.write(id, slot, index, action.bytes, keep);
    default: return master_.transport(id, slot, index, action.bytes, keep);
  }
}

}  // namespace dsdpv1::tb
