#include "model/systemc/sim_time.hpp"

#include <string>

namespace dsdpv1::systemc {
namespace {

constexpr std::uint64_t kFsPerThreeTicks = 250'000;

bool resolution_is_femtosecond() { return sc_core::sc_get_time_resolution().to_seconds() < 2e-15; }

void try_to_set_resolution() {
  try {
    sc_core::sc_set_time_resolution(1, sc_core::SC_FS);
  } catch (const sc_core::sc_report&) {
    // SystemC's own text does not say who asked or what to do; require_femtoseconds() reports instead.
  }
}

}  // namespace

sc_core::sc_time to_time(Tick tick) {
  const auto count = static_cast<std::uint64_t>(tick);
  const std::uint64_t rest = (count % 3 * kFsPerThreeTicks + 1) / 3;  // thirds of a femtosecond, rounded
  return sc_core::sc_time::from_value(count / 3 * kFsPerThreeTicks + rest);
}

Tick to_tick(const sc_core::sc_time& time) {
  const std::uint64_t fs = time.value();
  const std::uint64_t rest = (fs % kFsPerThreeTicks * 3 + kFsPerThreeTicks / 2) / kFsPerThreeTicks;
  return static_cast<Tick>(fs / kFsPerThreeTicks * 3 + rest);
}

void require_femtoseconds() {
  if (resolution_is_femtosecond()) return;
  try_to_set_resolution();
  if (resolution_is_femtosecond()) return;
  const std::string text = "the SystemC time resolution is fixed at " + sc_core::sc_get_time_resolution().to_string() +
                           ", 1 fs is needed: call sc_set_time_resolution(1, SC_FS) before the first sc_time is made";
  SC_REPORT_ERROR("/dsdpv1/time_resolution", text.c_str());
}

}  // namespace dsdpv1::systemc
