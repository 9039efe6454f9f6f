#pragma once
// The stations on the bench's segment, by their names in the scenario.
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/master/master1.hpp"
#include "tb/bench/answer_fault.hpp"
#include "tb/bench/class2_station.hpp"
#include "tb/bench/setup.hpp"
#include "tb/bench/slave_station.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

/// A class 1 master.
struct MasterStation {
  const scenario::Master* spec = nullptr;
  std::unique_ptr<bus::Master1> master;
  std::map<std::uint8_t, std::string> slaves;  ///< names by address
};

/// Makes it with its slaves, silent. `scenario` gives the rate, `setup` the slaves' parameters; `spec` must outlive it.
/// Throws InputError for values that the bus refuses.
MasterStation make_master(const scenario::Scenario& scenario, const scenario::Master& spec, Setup& setup,
                          bus::Segment& segment);

struct Stations {
  std::vector<std::unique_ptr<SlaveStation>> slaves;
  std::vector<MasterStation> masters;
  std::vector<std::unique_ptr<Class2Station>> masters2;
  std::vector<std::unique_ptr<AnswerFault>> answer_faults;  ///< by slave; none if there can be no order

  SlaveStation& slave(const std::string& name) const;
  /// As above, null if the slave is not on this bench.
  SlaveStation* find_slave(const std::string& name) const;
  /// The first one for an empty name.
  bus::Master1& master(const std::string& name) const;
  /// The class 2 master with this name, null without one; and the one that has this connection.
  Class2Station* class2(const std::string& name) const;
  Class2Station& owner_of(const std::string& connection) const;
  const bus::Connection& connection(const std::string& name) const { return owner_of(name).connection(name); }
  /// The master that exchanges data with a slave, null without one.
  const bus::Master1* master_of(const std::string& slave) const;
  /// The slave's address in the masters' lists.
  std::optional<std::uint8_t> listed_address(const std::string& slave) const;
  /// Changes the rate of all masters (bus/baud.hpp).
  void change_baud(int index);
};

}  // namespace dsdpv1::tb
