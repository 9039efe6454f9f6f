#include "tb/bench/stations.hpp"

#include <algorithm>
#include <stdexcept>

#include "io/input/input_error.hpp"

namespace dsdpv1::tb {
namespace {

void add_slave(MasterStation& station, const scenario::MasterSlave& slave, const bus::SlaveParameters& parameters) {
  station.master->add_slave(parameters);
  bus::Bytes outputs = slave.outputs;
  outputs.resize(static_cast<std::size_t>(parameters.output_length));
  station.master->set_outputs(parameters.address, outputs);
  station.master->vary_outputs(parameters.address, slave.pattern, slave.seed);
  station.slaves[parameters.address] = parameters.name;
}

}  // namespace

MasterStation make_master(const scenario::Scenario& scenario, const scenario::Master& spec, Setup& setup,
                          bus::Segment& segment) {
  bus::MasterConfig config;
  config.name = spec.name.text;
  config.address = static_cast<std::uint8_t>(spec.address);
  config.baud = scenario.baud;
  config.personality = spec.personality;
  config.bus = bus_parameters(spec.bus);
  MasterStation made;
  made.spec = &spec;
  made.master = std::make_unique<bus::Master1>(segment, config);
  for (const scenario::MasterSlave& slave : spec.slaves) {
    const bus::SlaveParameters parameters = setup.parameters(slave);
    try {
      add_slave(made, slave, parameters);
    } catch (const std::invalid_argument& error) {
      throw InputError(scenario.file, slave.line, error.what());
    }
  }
  if (!spec.operate) made.master->clear();
  return made;
}

SlaveStation* Stations::find_slave(const std::string& name) const {
  const auto found =
      std::find_if(slaves.begin(), slaves.end(), [&name](const auto& slave) { return slave->name() == name; });
  return found == slaves.end() ? nullptr : found->get();
}

SlaveStation& Stations::slave(const std::string& name) const {
  SlaveStation* found = find_slave(name);
  if (found == nullptr) throw std::out_of_range("no slave " + name);
  return *found;
}

bus::Master1& Stations::master(const std::string& name) const {
  for (const MasterStation& each : masters)
    if (name.empty() || each.spec->name.text == name) return *each.master;
  throw std::out_of_range("no master " + name);
}

Class2Station* Stations::class2(const std::string& name) const {
  for (const auto& each : masters2)
    if (each->name() == name) return each.get();
  return nullptr;
}

Class2Station& Stations::owner_of(const std::string& connection) const {
  for (const auto& each : masters2)
    if (each->has(connection)) return *each;
  throw std::out_of_range("no connection " + connection);
}

const bus::Master1* Stations::master_of(const std::string& slave) const {
  for (const MasterStation& each : masters) {
    for (const auto& [address, name] : each.slaves)
      if (name == slave) return each.master.get();
  }
  return nullptr;
}

std::optional<std::uint8_t> Stations::listed_address(const std::string& slave) const {
  for (const MasterStation& each : masters) {
    for (const auto& [address, name] : each.slaves)
      if (name == slave) return address;
  }
  return std::nullopt;
}

void Stations::change_baud(int index) {
  for (MasterStation& each : masters) each.master->change_baud(index);
  for (const auto& each : masters2) each->master().change_baud(index);
}

}  // namespace dsdpv1::tb
