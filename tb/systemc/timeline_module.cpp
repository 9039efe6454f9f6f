#include "tb/systemc/timeline_module.hpp"

#include <algorithm>

#include "model/systemc/sim_time.hpp"

namespace systemc_bench {
namespace {

// A wait that is woken stays in the kernel's queue until its time has come: few do when none is long.
constexpr bus::Tick kFarthest = 100 * bus::kTicksPerUs;

}  // namespace

using dsdpv1::systemc::to_time;

TimelineModule::TimelineModule(const sc_core::sc_module_name& name, bus::Timeline& timeline)
    : sc_module(name), timeline_(timeline) {
  dsdpv1::systemc::require_femtoseconds();
  SC_HAS_PROCESS(TimelineModule);
  SC_THREAD(run);
}

void TimelineModule::run() {
  for (;;) {
    const bus::Tick due = timeline_.next();
    if (due > dsdpv1::systemc::current_tick()) {
      sleep(due);
      continue;
    }
    wait(sc_core::SC_ZERO_TIME);  // every process that this time has woken goes first
    if (on_turn) on_turn();
    timeline_.run_until(dsdpv1::systemc::current_tick());
  }
}

void TimelineModule::sleep(bus::Tick due) {
  if (due == bus::kNever)
    wait(wake_);
  else
    wait(to_time(std::min(due, dsdpv1::systemc::current_tick() + kFarthest)) - sc_core::sc_time_stamp(), wake_);
}

}  // namespace systemc_bench
