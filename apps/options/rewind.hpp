#pragma once
// run --rewind-on: no wave is recorded until the event; then the run is repeated from a snapshot before it, with the
// wave.
#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "apps/options/run_arguments.hpp"
#include "apps/options/snapshots.hpp"
#include "tb/bench/bench.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::app {

class Rewind {
 public:
  /// Throws tb::InputError for a code or a time that is none, or where there can be no rewinding.
  Rewind(const RunArguments& arguments, const tb::scenario::Scenario& scenario);

  bool wanted() const { return !code_.empty(); }
  void ask(tb::RunOptions& options) const;
  /// The run of `bench`, whose polls call `look`. In a copy the process ends with it.
  tb::RunResult carry_out(tb::Bench& bench, const std::function<bool(tb::Tick now)>& poll);
  /// From time to time. False: the run ends.
  bool look(tb::Tick now);
  /// This process is the copy that records the wave.
  bool is_copy() const { return copy_; }

  /// The wave could not be recorded; why was said.
  bool failed() const { return failed_; }
  bool recorded() const { return recorded_.has_value(); }
  /// A line for the end of the run.
  std::string report() const;

 private:
  bool is_time_for_snapshot(tb::Tick now) const;
  void take_snapshot(tb::Tick now);
  void record(const tb::WaveRecorder::Trigger& trigger);

  std::string code_, file_, time_;
  tb::Tick around_ = 0;
  tb::Bench* bench_ = nullptr;
  Snapshots snapshots_;
  std::chrono::steady_clock::time_point last_;
  bool over_ = false, copy_ = false, failed_ = false;
  Window window_;  ///< of the copy
  std::optional<tb::WaveRecorder::Trigger> recorded_;
};

}  // namespace dsdpv1::app
