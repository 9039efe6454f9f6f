#pragma once
// Where the core's ticks (1/12 ns) meet sc_time. Conversion always starts from the absolute tick count and is rounded
// once, to 1 fs; two neighbouring ticks are at least 83333 fs apart, so tick -> time -> tick gives the tick back and
// nothing drifts.
#include <systemc>

#include "model/profibus/time.hpp"

namespace dsdpv1::systemc {

using profibus::Tick;

/// The simulation time of `tick` (>= 0, up to the end of SystemC's time at 1 fs, 18446 s), rounded to the nearest
/// femtosecond.
sc_core::sc_time to_time(Tick tick);

/// The tick nearest to `time`.
Tick to_tick(const sc_core::sc_time& time);

/// The tick nearest to the present simulation time.
inline Tick current_tick() { return to_tick(sc_core::sc_time_stamp()); }

/// From the present simulation time to `tick`, zero when that is over.
sc_core::sc_time time_until(Tick tick);

/// But for the process that asks, the kernel has nothing to do up to and including `tick`: no process to run, no signal
/// to update, no event to notify.
bool kernel_is_quiet(Tick tick);

/// Makes 1 fs the time resolution of the simulation. Reports the error /dsdpv1/time_resolution (which SystemC throws as
/// sc_core::sc_report) when another one is fixed already, because an sc_time was made before. Every module of this
/// library calls it when it is constructed; a program that makes an sc_time or sc_clock earlier calls it first in
/// sc_main. (After a program's own sc_set_time_resolution(1, SC_FS) it works as well, but SystemC then counts one
/// error: it offers no way to ask beforehand.)
void require_femtoseconds();

}  // namespace dsdpv1::systemc
