#pragma once
// A run in real time, with a host on the segment.
#include <memory>
#include <string>

#include "tb/bench/execution.hpp"
#include "tb/serve/host_link.hpp"

namespace dsdpv1::tb::serve {

/// HostLink says how simulated time follows real time.
class RealTimeExecution : public Execution {
 public:
  /// `baud` as in bus/baud.hpp.
  RealTimeExecution(std::unique_ptr<HostConnection> port, int baud);

  /// Call after the last make_chip and before `run`: the host acts after the chips.
  void join();
  void run(Tick end, const std::function<bool()>& stopped) override;

  /// Called in each round, between two steps of simulated time.
  std::function<void(Tick now)> on_round = [](Tick) {};
  HostLink& link() { return link_; }
  /// Prints one line about the port or the pace.
  std::function<void(Tick at, const std::string& text)> say = [](Tick, const std::string&) {};
  Pacing pacing() const { return link_.pacing(); }

 private:
  HostLink link_;
};

}  // namespace dsdpv1::tb::serve
