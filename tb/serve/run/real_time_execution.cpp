#include "tb/serve/run/real_time_execution.hpp"

#include <algorithm>
#include <utility>

namespace dsdpv1::tb::serve {

RealTimeExecution::RealTimeExecution(std::unique_ptr<HostConnection> port, int baud)
    : link_(std::move(port), segment_, baud) {
  link_.say = link_.late = [this](Tick at, const std::string& text) { say(at, text); };
}

void RealTimeExecution::join() { timeline_.add(link_.line()); }

void RealTimeExecution::run(Tick end, const std::function<bool()>& stopped) {
  link_.begin(timeline_.now());
  while (!stopped() && timeline_.now() < end) {
    link_.take(timeline_.now());
    on_round(timeline_.now());
    const Tick to = std::min(link_.limit(timeline_.now()), end);
    if (to > timeline_.now()) timeline_.run_until(to);
    link_.give(timeline_.now());
    link_.sleep(timeline_.now());
  }
  link_.end(timeline_.now());
}

}  // namespace dsdpv1::tb::serve
