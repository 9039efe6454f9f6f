#pragma once
// A class 2 master of the scenario with its connections by name.
#include <map>
#include <string>
#include <vector>

#include "bus/master/master2.hpp"
#include "bus/wire/segment.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

using bus::Tick;

class Journal;
class Observers;
class Replies;
struct Stations;

class Class2Station {
 public:
  /// All arguments must outlive it. `slaves` has those of the scenario. Throws InputError for values that the bus
  /// refuses.
  Class2Station(const scenario::Scenario& scenario, const scenario::Master2& spec, const Stations& slaves,
                bus::Segment& segment, Journal& journal, Replies& replies, const Observers& observers);
  Class2Station(const Class2Station&) = delete;
  Class2Station& operator=(const Class2Station&) = delete;

  const std::string& name() const { return spec_.name.text; }
  std::uint8_t address() const { return static_cast<std::uint8_t>(spec_.address); }
  bus::Master2& master() { return master_; }
  std::vector<std::string> connection_names() const;
  bool has(const std::string& connection) const { return ids_.count(connection) != 0; }
  const bus::Connection& connection(const std::string& connection) const {
    return master_.connection(ids_.at(connection));
  }
  /// Executes an action of the script on one of the connections.
  void act(const scenario::Action& action, Tick now);

 private:
  void add(const scenario::Scenario& scenario, const scenario::Connection& connection, const Stations& slaves);
  void listen();
  void ask(const scenario::Action& action, bus::ConnectionId id);

  Journal& journal_;
  Replies& replies_;
  const Observers& observers_;
  const scenario::Master2& spec_;
  bus::Master2 master_;
  std::map<std::string, bus::ConnectionId> ids_;
};

/// Bus parameters of the scenario for a master of either class.
bus::BusParameters bus_parameters(const scenario::BusParameters& bus);

}  // namespace dsdpv1::tb
