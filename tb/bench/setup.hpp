#pragma once
// Derives the data for user CPUs and masters from a scenario and its GSD files. All errors are InputErrors with file
// and line.
#include <map>
#include <string>

#include "bus/gsd/setup.hpp"
#include "bus/master/slave_parameters.hpp"
#include "tb/chip/user_cpu/station_config.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

/// Reads each GSD file once.
class Setup {
 public:
  /// `scenario` must outlive it.
  explicit Setup(const scenario::Scenario& scenario) : scenario_(scenario) {}

  /// The initialisation data of a slave: from its GSD and modules, overridden by the scenario.
  user_cpu::StationConfig station(const scenario::Slave& slave);
  /// A master's parameters for a slave.
  bus::SlaveParameters parameters(const scenario::MasterSlave& slave);
  /// The scenario's slave named in a master's list; null without one.
  const scenario::Slave* named(const scenario::MasterSlave& slave) const;

 private:
  [[noreturn]] void fail(int line, const std::string& text) const;
  const bus::Gsd& gsd(const scenario::Name& path);
  bus::GsdSetup choose(const scenario::Name& path, const std::vector<scenario::Name>& modules);
  void take_gsd(bus::SlaveParameters& parameters, const scenario::Name& path,
                const std::vector<scenario::Name>& modules);
  void take_init(bus::SlaveParameters& parameters, const scenario::Slave& slave);
  void take_lengths(bus::SlaveParameters& parameters, int line) const;
  void take_dpv1(bus::SlaveParameters& parameters, const scenario::MasterSlave& slave, const scenario::Slave* there);
  void take_alarms(bus::SlaveParameters& parameters, const scenario::MasterSlave& slave, const scenario::Slave* there);
  static const scenario::Name& gsd_path(const scenario::MasterSlave& slave, const scenario::Slave* there);

  const scenario::Scenario& scenario_;
  std::map<std::string, bus::Gsd> files_;
};

/// WD_Fact_1, WD_Fact_2 and the base for a watchdog time: the shortest that is at least this long. Off for 0.
struct Watchdog {
  std::uint8_t fact_1 = 0, fact_2 = 0;
  bool base_1ms = false;
};
Watchdog watchdog_factors(bus::Tick time);

}  // namespace dsdpv1::tb
