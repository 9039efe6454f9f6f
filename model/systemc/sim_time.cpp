#include "model/systemc/sim_time.hpp"

#include <string>

#include "model/systemc/main_stack.hpp"

namespace dsdpv1::systemc {
namespace {

constexpr std::uint64_t kFsPerThreeTicks = 250'000;

std::uint64_t femtoseconds(Tick tick) {
  const auto count = static_cast<std::uint64_t>(tick);
  const std::uint64_t rest = (count % 3 * kFsPerThreeTicks + 1) / 3;  // thirds of a femtosecond, rounded
  return count / 3 * kFsPerThreeTicks + rest;
}

std::uint64_t femtoseconds_until(Tick tick) {
  const std::uint64_t time = femtoseconds(tick), now = sc_core::sc_time_stamp().value();
  return time > now ? time - now : 0;
}

/// Asking SystemC for its resolution fixes it, so this is for after an attempt to set it.
bool resolution_is_femtosecond() { return sc_core::sc_get_time_resolution().to_seconds() < 2e-15; }

/// SystemC refuses a second setting, also of the same value; its own text does not say who asked or what to do.
void try_to_set_resolution() {
  const sc_core::sc_report_handler_proc handler = sc_core::sc_report_handler::get_handler();
  sc_core::sc_report_handler::set_handler(
      [](const sc_core::sc_report& report, const sc_core::sc_actions&) { throw report; });
  try {
    sc_core::sc_set_time_resolution(1, sc_core::SC_FS);
  } catch (const sc_core::sc_report&) {
  }
  sc_core::sc_report_handler::set_handler(handler);
}

}  // namespace

sc_core::sc_time to_time(Tick tick) { return sc_core::sc_time::from_value(femtoseconds(tick)); }

Tick to_tick(const sc_core::sc_time& time) {
  const std::uint64_t fs = time.value();
  const std::uint64_t rest = (fs % kFsPerThreeTicks * 3 + kFsPerThreeTicks / 2) / kFsPerThreeTicks;
  return static_cast<Tick>(fs / kFsPerThreeTicks * 3 + rest);
}

sc_core::sc_time time_until(Tick tick) { return sc_core::sc_time::from_value(femtoseconds_until(tick)); }

bool kernel_is_quiet(Tick tick) { return sc_core::sc_time_to_pending_activity().value() > femtoseconds_until(tick); }

void require_femtoseconds() {
  announce_main_stack_at_exit();  // here, as every program with a simulation comes by

  static bool done = false;  // the resolution is a property of the process
  if (!done) try_to_set_resolution();
  done = resolution_is_femtosecond();
  if (done) return;
  const std::string text =
      "the SystemC time resolution is fixed at " + sc_core::sc_get_time_resolution().to_string() +
      ", 1 fs is needed: call dsdpv1::systemc::require_femtoseconds() before the first sc_time is made";
  SC_REPORT_ERROR("/dsdpv1/time_resolution", text.c_str());
}

}  // namespace dsdpv1::systemc
