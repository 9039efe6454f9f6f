#pragma once
// The line of a chip's TLM module beside its ports, for a segment that the chip is a station of: levels at their ticks,
// and telegrams as a whole while nothing disturbs them. tb/systemc/segment_module.hpp is such a segment.
#include <functional>

#include "model/profibus/character_run.hpp"

namespace dsdpv1::systemc {

using profibus::Tick;

/// Ticks are the chip's: simulation time less the phase. The functions are set before the simulation starts.
class LineStation {
 public:
  virtual ~LineStation() = default;

  /// Called for every change of the driver's enable (PBRTS, RTS) and of its input (PBTXD, TXD), at its tick, maybe from
  /// inside of the core. An answer taken by `on_answer` has no changes of the input.
  std::function<void(Tick at, bool level)> on_rts, on_txd;
  /// Called at the begin of an answer, instead of changes of PBTXD. Return true to hide PBTXD until PBRTS falls, or
  /// until show_txd is called before the run's end: PBTXD then takes its present level without a report. Not called
  /// while something else needs each change.
  std::function<bool(const profibus::CharacterRun& run)> on_answer;
  /// The chip has left the run of hear_run: it needs the changes from `at` on.
  std::function<void(Tick at)> on_left_run;

  /// The line is at this level from the present time on. It shares the wire with PBRXD (RXD) and `bus_in`: a low of any
  /// wins.
  virtual void set_line(bool level) = 0;
  /// Replaces the changes of PBRXD that the characters of `run` cause, from the present time on, which is the run's
  /// start. False: the changes are needed. True: PBRXD stays high until the run ends or is left. leave_run at the
  /// present time leaves it, and PBRXD carries the rest; if the module leaves it, it calls `on_left_run`.
  virtual bool hear_run(const profibus::CharacterRun& run) = 0;
  virtual void leave_run() = 0;
  virtual void show_txd() = 0;
};

}  // namespace dsdpv1::systemc
