#include "model/systemc/core_module.hpp"

namespace dsdpv1::systemc {

TimedModule::TimedModule(const sc_core::sc_module_name& name, Tick phase) : sc_core::sc_module(name), phase_(phase) {
  require_resolution();
  if (phase < 0 || phase >= profibus::kTicksPerCycle) {
    const std::string text = "phase is " + std::to_string(phase) + " ticks, expected 0 to 249";
    SC_REPORT_ERROR("/dsdpv1/phase", text.c_str());
  }
}

void TimedModule::drive(std::uint32_t pins) {
  for (auto wire = wires_.begin(); wire != wires_.end() && pins != 0; ++wire) {
    if ((pins & wire->pin) == 0) continue;
    wire->signal->write((high_ & wire->pin) != 0);
    pins &= ~wire->pin;
  }
}

// A notification that is no longer needed is not cancelled: the kernel keeps cancelled ones in its queue until their
// time, and a watchdog that every telegram moves would leave thousands there. For the same reason no notification is
// made for a time far ahead.
void TimedModule::schedule(Tick now, Tick due) {
  constexpr Tick kFarthest = 100'000 * profibus::kTicksPerNs;
  if (due == profibus::kNever) return;
  // Everything of this tick is done; scheduling it again would stop simulation time.
  const Tick at = std::min(std::max(due, now + 1), now + kFarthest);
  if (scheduled_ > now && scheduled_ <= at) return;
  scheduled_ = at;
  scheduled_at_ = to_time(at + phase_);
  due_.notify(scheduled_at_ - sc_core::sc_time_stamp());
}

void TimedModule::unschedule() {
  scheduled_ = 0;
  scheduled_at_ = sc_core::sc_max_time();
  due_.cancel();
}

}  // namespace dsdpv1::systemc
