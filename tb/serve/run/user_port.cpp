#include "tb/serve/run/user_port.hpp"

#include <fmt/format.h>

#include <utility>

namespace dsdpv1::tb::serve {

UserPort::UserPort(std::unique_ptr<HostConnection> port, user_cpu::OutsideLine& line)
    : port_(std::move(port)), line_(line) {
  port_->say = [this](const std::string& text) {
    const WallTime now = WallClock::now();
    if (const std::uint64_t count = lines_.left_out(now))
      say(now_, fmt::format("user CPU, {}: {} more such lines are left out", port_->name(), count));
    if (lines_.allows(now)) say(now_, "user CPU, " + text);
  };
  port_->on_gone = [this] { line_.from_chip.clear(); };
}

void UserPort::look(bus::Tick now) {
  now_ = now;
  port_->send(std::exchange(line_.from_chip, {}));
  const bus::Bytes bytes = port_->receive(user_cpu::OutsideLine::kMostWaiting - line_.to_chip.size());
  if (bytes.empty() || !line_.on_bytes) return;
  line_.to_chip.insert(line_.to_chip.end(), bytes.begin(), bytes.end());
  line_.on_bytes(now);
}

}  // namespace dsdpv1::tb::serve
