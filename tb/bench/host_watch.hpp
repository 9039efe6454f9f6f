#pragma once
// The telegrams between chips with a serial host port and their users: one reader per slave.
#include <algorithm>
#include <memory>
#include <vector>

#include "bus/timeline.hpp"
#include "tb/bench/observer.hpp"
#include "tb/chip/host_reader.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

class HostWatch : public Observer {
 public:
  /// Both must outlive it. `wanted`: a listener needs the telegrams.
  HostWatch(const scenario::Scenario& scenario, bool wanted, const Observers& observers);
  HostWatch(const HostWatch&) = delete;
  HostWatch& operator=(const HostWatch&) = delete;

  bool reads_any() const {
    return std::any_of(
        readers_.begin(), readers_.end(), [](const auto& reader) { return reader != nullptr; });
  }
  /// The slave's, as in HostReader; null: nothing is read.
  const char* port(std::size_t slave) const { return reads(slave) ? readers_[slave]->port() : nullptr; }
  /// Its pins that must be watched, none if nothing is read.
  PinMask pins(std::size_t slave) const { return reads(slave) ? readers_[slave]->pins() : 0; }
  void add_to(bus::Timeline& timeline);
  void pin(std::size_t slave, Tick at, PinNumber pin, Level level) override {
    if (reads(slave)) readers_[slave]->pin(at, pin, level);
  }

 private:
  bool reads(std::size_t slave) const { return slave < readers_.size() && readers_[slave] != nullptr; }

  std::vector<std::unique_ptr<HostReader>> readers_;  ///< by slave, null for other ports; or none
};

}  // namespace dsdpv1::tb
