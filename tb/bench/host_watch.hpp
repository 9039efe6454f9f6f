#pragma once
// The telegrams between chips with a serial host port and their users: one reader per slave.
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

  /// As in HostReader; null: nothing is read.
  const char* port() const { return readers_.empty() ? nullptr : readers_.front()->port(); }
  /// The pins that must be watched, none if nothing is read.
  PinMask pins() const { return readers_.empty() ? 0 : readers_.front()->pins(); }
  void add_to(bus::Timeline& timeline);
  void pin(std::size_t slave, Tick at, PinNumber pin, Level level) override { readers_[slave]->pin(at, pin, level); }

 private:
  std::vector<std::unique_ptr<HostReader>> readers_;  ///< by slave, or none
};

}  // namespace dsdpv1::tb
