#pragma once
// Converts between the core's ticks (1/12 ns) and sc_time, at any resolution from 1 fs to 1 ps. Conversion always
// starts from the absolute tick count and rounds once, so nothing drifts: the time of a tick is off by at most a third
// of the resolution, 333 fs at 1 ps. Neighbouring ticks are 83 ps apart, so a tick converted to time and back is the
// same tick.
#include <cstdint>
#include <systemc>

#include "model/profibus/time.hpp"

namespace dsdpv1::systemc {

using profibus::Tick;

/// The simulation time of `tick` (>= 0, up to the end of SystemC's time: 18446 s at 1 fs, a thousand times that at 1
/// ps), rounded to the nearest unit of the resolution. Like all functions here, it reports the error
/// /dsdpv1/time_resolution at a resolution that is not allowed.
sc_core::sc_time to_time(Tick tick);

/// The tick nearest to `time`; half way, the later one.
Tick to_tick(const sc_core::sc_time& time);

/// The tick nearest to the present simulation time.
Tick current_tick();

/// From the present simulation time to that of `tick`, zero if it has passed.
sc_core::sc_time time_until(Tick tick);

/// A length of time in a state, in femtoseconds: resolutions may differ.
template <class Archive>
void store_duration(Archive& archive, sc_core::sc_time& duration) {
  const double unit = sc_core::sc_get_time_resolution().to_seconds() * 1e15;  // 1, 10, 100, 1000
  auto femtoseconds = static_cast<std::int64_t>(static_cast<double>(duration.value()) * unit);
  archive(femtoseconds);
  duration = sc_core::sc_time::from_value(static_cast<sc_dt::uint64>(static_cast<double>(femtoseconds) / unit));
}

/// Apart from the calling process the kernel is idle before this tick: no process to run, no signal to update, no event
/// to notify.
Tick kernel_quiet_until();

/// Fixes the time resolution of the simulation at the program's setting, or at SystemC's default of 1 ps, and reports
/// the error /dsdpv1/time_resolution (thrown by SystemC as sc_core::sc_report) if it is not 1 fs to 1 ps. Every module
/// of this library calls it in its constructor.
void require_resolution();

/// For programs that need SystemC's finest resolution, whose time ends after 18446 s: sets the time resolution to 1 fs,
/// or reports the error /dsdpv1/time_resolution if another one is already fixed by an sc_time or a module. Call it
/// first in sc_main. (After a program's own sc_set_time_resolution(1, SC_FS) it works as well, but SystemC then counts
/// one error, because it offers no way to ask beforehand.)
void require_femtoseconds();

}  // namespace dsdpv1::systemc
