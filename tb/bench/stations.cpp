#include "tb/bench/stations.hpp"

#include <algorithm>
#include <stdexcept>

namespace dsdpv1::tb {

SlaveStation& Stations::slave(const std::string& name) const {
  const auto found =
      std::find_if(slaves.begin(), slaves.end(), [&name](const auto& slave) { return slave->name() == name; });
  if (found == slaves.end()) throw std::out_of_range("no slave " + name);
  return **found;
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
