#include "model/systemc/sim_time.hpp"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "model/systemc/main_stack.hpp"

namespace dsdpv1::systemc {
namespace {

constexpr std::uint64_t kFsPerThreeTicks = 250'000;
constexpr std::uint64_t kFinest = 1, kCoarsest = 1000;  ///< femtoseconds

/// Reading SystemC's resolution fixes it.
std::uint64_t resolution_in_femtoseconds() {
  return static_cast<std::uint64_t>(std::llround(sc_core::sc_get_time_resolution().to_seconds() * 1e15));
}

/// Kept out of line so that the per-event path stays small.
[[gnu::cold, gnu::noinline]] std::uint64_t checked_resolution() {
  const std::uint64_t femtoseconds = resolution_in_femtoseconds();
  if (femtoseconds >= kFinest && femtoseconds <= kCoarsest) return femtoseconds;
  const std::string text =
      "the SystemC time resolution is " + sc_core::sc_get_time_resolution().to_string() +
      ", expected 1 fs to 1 ps (a tick of the chip is 83.3 ps): call sc_core::sc_set_time_resolution(1, "
      "sc_core::SC_PS) before the first sc_time is made";
  SC_REPORT_ERROR("/dsdpv1/time_resolution", text.c_str());
  throw std::runtime_error(text);  // if reports of errors do not throw: no time would be right
}

/// Zero, one, two and three ticks in units of the simulation's resolution, rounded; three are 250 ps, a whole number of
/// units, since SystemC allows powers of ten only.
const std::array<std::uint64_t, 4>& units_of_ticks() {
  // Not a guarded constant, because every event reads it several times.
  static std::array<std::uint64_t, 4> units = {};
  if (units[3] == 0) {
    units[3] = kFsPerThreeTicks / checked_resolution();
    for (std::size_t ticks = 1; ticks < 3; ++ticks) units[ticks] = (ticks * units[3] + 1) / 3;
  }
  return units;
}

std::uint64_t units(Tick tick) {
  const auto count = static_cast<std::uint64_t>(tick);
  const std::array<std::uint64_t, 4>& of = units_of_ticks();
  return count / 3 * of[3] + of[count % 3];
}

/// A constant divisor lets the compiler avoid the division instruction.
template <std::uint64_t kInThree>
Tick nearest_tick(std::uint64_t value) {
  const std::uint64_t rest = (value % kInThree * 3 + kInThree / 2) / kInThree;
  return static_cast<Tick>(value / kInThree * 3 + rest);
}

std::uint64_t units_until(Tick tick) {
  const std::uint64_t time = units(tick), now = sc_core::sc_time_stamp().value();
  return time > now ? time - now : 0;
}

/// SystemC refuses a second setting, even of the same value; its text names neither the caller nor a remedy.
void try_to_set_femtoseconds() {
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

sc_core::sc_time to_time(Tick tick) { return sc_core::sc_time::from_value(units(tick)); }

Tick to_tick(const sc_core::sc_time& time) {
  const std::uint64_t in_three = units_of_ticks()[3];
  if (in_three == 250'000) return nearest_tick<250'000>(time.value());
  if (in_three == 250) return nearest_tick<250>(time.value());
  return in_three == 25'000 ? nearest_tick<25'000>(time.value()) : nearest_tick<2'500>(time.value());
}

/// Cached, because it is queried often at the same simulation time.
Tick current_tick() {
  static std::uint64_t time = 0;
  static Tick tick = 0;
  const sc_core::sc_time& now = sc_core::sc_time_stamp();
  if (now.value() == time) return tick;
  time = now.value();
  return tick = to_tick(now);
}

sc_core::sc_time time_until(Tick tick) { return sc_core::sc_time::from_value(units_until(tick)); }

Tick kernel_quiet_until() {
  const sc_core::sc_time pending = sc_core::sc_time_stamp() + sc_core::sc_time_to_pending_activity();
  const Tick tick = to_tick(pending);
  return units(tick) < pending.value() ? tick + 1 : tick;
}

void require_resolution() {
  announce_main_stack_at_exit();  // here, because every program with a simulation calls this function
  checked_resolution();
}

void require_femtoseconds() {
  static bool done = false;  // the resolution is a property of the process
  if (!done) try_to_set_femtoseconds();
  done = resolution_in_femtoseconds() == 1;
  if (done) return;
  const std::string text =
      "the SystemC time resolution is fixed at " + sc_core::sc_get_time_resolution().to_string() +
      ", 1 fs is wanted: call dsdpv1::systemc::require_femtoseconds() before the first sc_time is made";
  SC_REPORT_ERROR("/dsdpv1/time_resolution", text.c_str());
}

}  // namespace dsdpv1::systemc
