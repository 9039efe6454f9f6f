#include "tb/systemc/timeline_module.hpp"

#include <algorithm>

#include "model/systemc/has_process.hpp"
#include "model/systemc/sim_time.hpp"

namespace dsdpv1::systemc_bench {
namespace {

// A wait that is woken stays in the kernel's queue until its time: with short waits only few do.
constexpr bus::Tick kFarthest = 100 * bus::kTicksPerUs;

}  // namespace

TimelineModule::TimelineModule(const sc_core::sc_module_name& name, bus::Timeline& timeline)
    : sc_module(name), timeline_(timeline) {
  dsdpv1::systemc::require_resolution();
  DSDPV1_HAS_PROCESS(TimelineModule);
  SC_THREAD(run);
}

void TimelineModule::run() {
  for (;;) {
    const bus::Tick due = timeline_.next();
    if (due > dsdpv1::systemc::current_tick()) {
      sleep(due);
      continue;
    }
    if (sc_core::sc_pending_activity_at_current_time())
      wait(sc_core::SC_ZERO_TIME);  // processes woken at this time run first
    follow_accesses();
    in_turn_ = true;
    while (timeline_.next() <= dsdpv1::systemc::current_tick()) {
      timeline_.step(limit);
      if (stopped()) return sc_core::sc_pause();
    }
    in_turn_ = false;
  }
}

bool TimelineModule::in_access() const {
  return std::any_of(
      chips_.begin(), chips_.end(), [](const auto* chip) { return chip->in_access(); });
}

void TimelineModule::follow_accesses() {
  for (dsdpv1::systemc::TlmModule* chip : chips_)
    if (chip->in_access()) chip->sync();
}

bus::Tick TimelineModule::quiet_until(const bus::Agent& agent) {
  return in_access() ? 0 : std::min(dsdpv1::systemc::kernel_quiet_until(), timeline_.quiet_until(agent));
}

bool TimelineModule::go_on(const bus::Agent& agent, bus::Tick tick) {
  return !in_access() && dsdpv1::systemc::kernel_quiet_until() > tick && timeline_.go_on(agent, tick);
}

void TimelineModule::catch_up() {
  if (!in_turn_ || timeline_.now() <= dsdpv1::systemc::current_tick()) return;
  in_turn_ = false;
  wait(dsdpv1::systemc::time_until(timeline_.now()));
  in_turn_ = true;
}

void TimelineModule::sleep(bus::Tick due) {
  if (due == bus::kNever)
    wait(wake_);
  else
    wait(dsdpv1::systemc::time_until(std::min(due, dsdpv1::systemc::current_tick() + kFarthest)), wake_);
}

}  // namespace dsdpv1::systemc_bench
