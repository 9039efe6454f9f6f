#pragma once
// A program outside of the simulation, at a port, as the user of a chip with a serial line.
#include <functional>
#include <memory>
#include <string>

#include "tb/chip/user_cpu/outside_line.hpp"
#include "tb/serve/host_connection.hpp"
#include "tb/serve/line_limit.hpp"

namespace dsdpv1::tb::serve {

class UserPort {
 public:
  /// `line` must outlive it.
  UserPort(std::unique_ptr<HostConnection> port, user_cpu::OutsideLine& line);

  std::string name() const { return port_->name(); }
  /// Passes bytes on in both directions, without waiting; `now` is simulated time.
  void look(bus::Tick now);
  /// Prints one line about the port; at most LineLimit's number in a second.
  std::function<void(bus::Tick at, const std::string& text)> say = [](bus::Tick, const std::string&) {};

 private:
  std::unique_ptr<HostConnection> port_;
  user_cpu::OutsideLine& line_;
  LineLimit lines_;
  bus::Tick now_ = 0;
};

}  // namespace dsdpv1::tb::serve
