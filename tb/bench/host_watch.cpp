#include "tb/bench/host_watch.hpp"

#include <utility>

namespace dsdpv1::tb {

HostWatch::HostWatch(const scenario::Scenario& scenario, bool wanted, const Observers& observers) {
  for (std::size_t slave = 0; wanted && slave < scenario.slaves.size(); ++slave) {
    const scenario::Slave& own = scenario.slaves[slave];
    std::unique_ptr<HostReader>& reader = readers_.emplace_back(own.kind->make_host_reader(*own.chip));
    if (reader == nullptr) continue;
    reader->on_telegram = [&observers, slave](const HostTelegram& telegram) {
      observers.tell(&Observer::host_telegram, slave, telegram);
    };
  }
}

void HostWatch::add_to(bus::Timeline& timeline) {
  for (const auto& reader : readers_)
    if (reader != nullptr) timeline.add(*reader);
}

}  // namespace dsdpv1::tb
