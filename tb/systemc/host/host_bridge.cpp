#include "tb/systemc/host/host_bridge.hpp"

#include <utility>

#include "model/systemc/has_process.hpp"
#include "model/systemc/sim_time.hpp"

namespace dsdpv1::systemc_bench {

using dsdpv1::systemc::current_tick;

HostBridge::HostBridge(const sc_core::sc_module_name& name, std::unique_ptr<tb::serve::HostConnection> port,
                       SegmentModule& line, int baud)
    : sc_module(name), line_(line), link_(std::move(port), line.segment(), baud) {
  line_.add(link_.line());
  const auto named = [this](const std::string& text) { return std::string(this->name()) + ": " + text; };
  say = [named](const std::string& text) { SC_REPORT_INFO("/dsdpv1/host", named(text).c_str()); };
  late = [named](const std::string& text) { SC_REPORT_WARNING("/dsdpv1/late", named(text).c_str()); };
  link_.say = [this](bus::Tick, const std::string& text) { say(text); };
  link_.late = [this](bus::Tick, const std::string& text) { late(text); };
  DSDPV1_HAS_PROCESS(HostBridge);
  SC_THREAD(run);
}

void HostBridge::run() {
  link_.begin(current_tick());
  while (!stopped()) slice();
  link_.end(current_tick());
  sc_core::sc_pause();
}

void HostBridge::slice() {
  link_.take(current_tick());
  line_.agents().wake();
  if (const bus::Tick to = link_.limit(current_tick()); to > current_tick()) wait(dsdpv1::systemc::time_until(to));
  link_.give(current_tick());
  link_.sleep(current_tick());
}

}  // namespace dsdpv1::systemc_bench
