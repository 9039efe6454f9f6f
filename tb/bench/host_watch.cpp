#include "tb/bench/host_watch.hpp"

#include <utility>

namespace dsdpv1::tb {

HostWatch::HostWatch(const scenario::Scenario& scenario, bool wanted, const Observers& observers) {
  for (std::size_t slave = 0; wanted && slave < scenario.slaves.size(); ++slave) {
    std::unique_ptr<HostReader> reader = scenario.kind->make_host_reader(*scenario.chip);
    if (reader == nullptr) return;
    reader->on_telegram = [&observers, slave](const HostTelegram& telegram) {
      observers.tell(&Observer::host_telegram, slave, telegram);
    };
    readers_.push_back(std::move(reader));
  }
}

void HostWatch::add_to(bus::Timeline& timeline) {
  for (const auto& reader : readers_) timeline.add(*reader);
}

}  // namespace dsdpv1::tb
