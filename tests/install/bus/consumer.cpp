// A master polls a missing slave, a monitor counts its telegrams, and the checks judge a user who writes without a
// request.
#include <dsdpv1/bus/master/master1.hpp>
#include <dsdpv1/bus/monitor/monitor.hpp>
#include <dsdpv1/kinds/dsdpv1/checks/checks.hpp>

namespace {

std::uint64_t telegrams_of_a_master() {
  dsdpv1::bus::Segment segment;
  dsdpv1::bus::Timeline timeline;
  dsdpv1::bus::Master1 master(segment, dsdpv1::bus::MasterConfig{});
  dsdpv1::bus::Monitor monitor(segment);
  monitor.set_baud(0);
  timeline.add(master);
  timeline.add(monitor);
  dsdpv1::bus::SlaveParameters slave;
  slave.address = 3;
  slave.cfg = {0x11};
  master.add_slave(slave);
  master.start();
  timeline.run_until(10'000 * dsdpv1::bus::kTicksPerUs);
  return monitor.statistics().wrong == 0 ? monitor.statistics().telegrams : 0;
}

std::uint64_t violations_of_a_write() {
  using dsdpv1::Pin;
  dsdpv1::checks::Checks checks;
  checks.pin(0, Pin::kReset, 1);
  constexpr dsdpv1::bus::Tick kAccess = 2'000'000, kLow = 600;
  checks.pin(kAccess, Pin::kCsr, 0);
  checks.pin(kAccess + kLow, Pin::kWr, 0);
  checks.pin(kAccess + 2 * kLow, Pin::kWr, 1);
  checks.pin(kAccess + 3 * kLow, Pin::kCsr, 1);
  checks.finish(2 * kAccess);
  return checks.record(dsdpv1::checks::Check::kNotOwner).violations;
}

}  // namespace

int main() { return telegrams_of_a_master() > 10 && violations_of_a_write() == 1 ? 0 : 1; }
