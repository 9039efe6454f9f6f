#pragma once
// A class 2 master of the scenario with its connections, by their names.
#include <map>
#include <string>

#include "bus/master/master2.hpp"
#include "tb/scenario/scenario.hpp"

namespace tb {

class Bench;

class Class2Station {
 public:
  /// `bench` and `spec` must outlive it. Throws InputError for values that the bus refuses.
  Class2Station(Bench& bench, const scenario::Master2& spec);
  Class2Station(const Class2Station&) = delete;
  Class2Station& operator=(const Class2Station&) = delete;

  const std::string& name() const { return spec_.name.text; }
  bus::Master2& master() { return master_; }
  std::vector<std::string> connection_names() const;
  bool has(const std::string& connection) const { return ids_.count(connection) != 0; }
  const bus::Connection& connection(const std::string& connection) const {
    return master_.connection(ids_.at(connection));
  }
  /// Carries out an action of the script that is about one of the connections.
  void act(const scenario::Action& action);

 private:
  void add(const scenario::Connection& connection);
  void listen();
  void ask(const scenario::Action& action, bus::ConnectionId id);

  Bench& bench_;
  const scenario::Master2& spec_;
  bus::Master2 master_;
  std::map<std::string, bus::ConnectionId> ids_;
};

/// Bus parameters of the scenario for a master of either class.
bus::BusParameters bus_parameters(const scenario::BusParameters& bus);

}  // namespace tb
