#pragma once
// Where the core's ticks (1/12 ns) meet sc_time, at whatever resolution the simulation has, from 1 fs to 1 ps.
// Conversion always starts from the absolute tick count and is rounded once, so nothing drifts: the time of a tick is
// wrong by a third of the resolution at most, 333 fs at 1 ps. Two neighbouring ticks are 83 ps apart, so tick -> time
// -> tick gives the tick back.
#include <systemc>

#include "model/profibus/time.hpp"

namespace dsdpv1::systemc {

using profibus::Tick;

/// The simulation time of `tick` (>= 0, up to the end of SystemC's time: 18446 s at 1 fs, a thousand times that at
/// 1 ps), rounded to the nearest unit of the resolution. As all of these functions, it reports the error
/// /dsdpv1/time_resolution at a resolution that is not allowed.
sc_core::sc_time to_time(Tick tick);

/// The tick nearest to `time`, half way the later one.
Tick to_tick(const sc_core::sc_time& time);

/// The tick nearest to the present simulation time.
Tick current_tick();

/// From the present simulation time to that of `tick`, zero when it is over.
sc_core::sc_time time_until(Tick tick);

/// But for the process that asks, the kernel has nothing to do before this tick: no process to run, no signal to
/// update, no event to notify.
Tick kernel_quiet_until();

/// Fixes the time resolution of the simulation at what the program has set, or at SystemC's own 1 ps, and reports the
/// error /dsdpv1/time_resolution (which SystemC throws as sc_core::sc_report) when it is not 1 fs to 1 ps. Every module
/// of this library calls it when it is constructed.
void require_resolution();

/// For programs that want SystemC's finest resolution, which ends after 18446 s: makes 1 fs the time resolution, or
/// reports the error /dsdpv1/time_resolution when another one is fixed already, because an sc_time or a module was made
/// before. First thing in sc_main. (After a program's own sc_set_time_resolution(1, SC_FS) it works as well, but
/// SystemC then counts one error: it offers no way to ask beforehand.)
void require_femtoseconds();

}  // namespace dsdpv1::systemc
