#include "apps/options/rewind.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <tuple>

#include "apps/exit_codes.hpp"
#include "apps/options/wave_options.hpp"
#include "io/input/input_error.hpp"
#include "io/output/output_place.hpp"
#include "tb/bench/run_log.hpp"

namespace dsdpv1::app {
namespace {

using std::chrono::steady_clock;

// A snapshot costs some milliseconds of real time. From then on the system copies each page that the snapshot or this
// process changes.
constexpr std::chrono::milliseconds kBetween(500);
// An event may be reported so much later than it happens; a wave needs so much lead until it is correct.
constexpr tb::Tick kLate = 2 * bus::kTicksPerMs;

}  // namespace

Rewind::Rewind(const RunArguments& arguments, const tb::scenario::Scenario& scenario) {
  if (arguments.rewind_on.first.empty()) return;
  std::tie(code_, time_) = arguments.rewind_on;
  file_ = arguments.wave.file;
  around_ = check_window("dsdpv1-sim run", "--rewind-on", code_, time_, kinds(scenario));
  if (arguments.view != "pins" || (arguments.engine != "step" && arguments.engine != "skip"))
    throw tb::InputError(
        "dsdpv1-sim run: --rewind-on is about the model, it needs --view pins and --engine step or skip");
  for (const tb::scenario::Slave& each : scenario.slaves)
    if (each.kind->has_process(each))
      throw tb::InputError(scenario.file, each.line,
                           fmt::format("the user CPU of {} is a process, which cannot be rewound; expected --wave-on "
                                       "instead of --rewind-on",
                                       each.name.text));
  tb::find_place(file_);
}

void Rewind::ask(tb::RunOptions& options) const {
  if (!wanted()) return;
  options.wave.on = {code_};
  options.wave.selection.from = bus::kNever;
  options.wave.asleep = true;
}

tb::RunResult Rewind::carry_out(tb::Bench& bench, const std::function<bool(tb::Tick now)>& poll) {
  bench_ = &bench;
  try {
    if (wanted()) take_snapshot(0);
    tb::RunResult result = bench.run(poll);
    if (!copy_) return result;
  } catch (const tb::InputError& error) {
    if (!copy_) throw;
    std::cerr << error.what() << '\n';
    bench.drop_wave();
    ::_exit(kWrongInput);
  }
  ::_exit(kPassed);  // without destructors: all else that is open belongs to the parent
}

bool Rewind::look(tb::Tick now) {
  if (!wanted() || over_) return true;
  if (copy_) return now <= window_.to;
  if (const tb::WaveRecorder::Trigger* trigger = bench_->wave_trigger())
    record(*trigger);
  else if (is_time_for_snapshot(now))
    take_snapshot(now);
  return !failed_;
}

bool Rewind::is_time_for_snapshot(tb::Tick now) const {
  return snapshots_.possible() && now - snapshots_.newest() > around_ + kLate &&
         steady_clock::now() - last_ >= kBetween;
}

void Rewind::take_snapshot(tb::Tick now) {
  snapshots_.forget_before(now - around_ - kLate);
  const std::optional<Window> woken = snapshots_.take(now);
  last_ = steady_clock::now();
  if (!woken) return;
  copy_ = true;
  window_ = *woken;
  bench_->keep_only_wave();
  bench_->wake_wave(window_.from, window_.to);
}

void Rewind::record(const tb::WaveRecorder::Trigger& trigger) {
  over_ = true;
  const Window window{std::max<tb::Tick>(trigger.at - around_, 0), trigger.at + around_};
  if (snapshots_.empty()) throw tb::InputError("dsdpv1-sim run: --rewind-on: the system allows no second process");
  const int status = snapshots_.wake(window.from - kLate, window);
  if (status == -1) std::cerr << "dsdpv1-sim run: the process that recorded " << file_ << " was killed" << '\n';
  failed_ = status != kPassed;
  if (failed_) return bench_->leave_nothing();
  recorded_ = trigger;
  snapshots_.clear();
}

std::string Rewind::report() const {
  if (!wanted()) return "";
  if (!recorded_) return fmt::format("rewound           nothing of {} happened, there is no {}\n", code_, file_);
  return fmt::format("rewound           {} has {} round {} at {} ns at {}\n", file_, time_, recorded_->code,
                     tb::nanoseconds(recorded_->at), recorded_->station);
}

}  // namespace dsdpv1::app
