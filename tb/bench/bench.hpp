#pragma once
// Runs a scenario: builds the stations, runs the timeline, collects events. The script is in script.hpp, the evaluation
// of conditions in conditions.hpp.
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bus/monitor/monitor.hpp"
#include "tb/bench/capture_recorder.hpp"
#include "tb/bench/check_watch.hpp"
#include "tb/bench/exchange_watch.hpp"
#include "tb/bench/execution.hpp"
#include "tb/bench/host_watch.hpp"
#include "tb/bench/journal.hpp"
#include "tb/bench/marks.hpp"
#include "tb/bench/observer.hpp"
#include "tb/bench/periodic_poll.hpp"
#include "tb/bench/pin_trace.hpp"
#include "tb/bench/record.hpp"
#include "tb/bench/reply.hpp"
#include "tb/bench/run_digest.hpp"
#include "tb/bench/setup.hpp"
#include "tb/bench/stations.hpp"
#include "tb/bench/wave_recorder.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

class Script;

/// A program outside of the simulation; `line` must outlive the bench.
struct OutsideUser {
  std::string slave;
  user_cpu::OutsideLine* line;
};

struct RunOptions {
  Engine engine = Engine::kSkip;
  std::string engine_name = "skip", view_name = "pins";
  WaveOptions wave;
  std::string log, trace;              ///< paths, empty: none
  bool log_whole = false;              ///< the log contains all bytes
  CaptureRequest capture;              ///< of the telegrams
  std::optional<GdbRequest> gdb;       ///< debugger of the first user CPU that supports one
  std::optional<OutsideUser> outside;  ///< the user of one chip is a program outside of the simulation
  std::function<void(const std::string& station, const std::string& line)> on_text;  ///< lines printed by user CPUs
  std::optional<ChecksMode> checks;                                                  ///< absent: as in the scenario
  Tick from = 0;  ///< start of log, trace, capture, wave and the output of user CPUs
  std::vector<Tick>
      marks;  ///< times at which `on_mark` is called, before any agent acts there; a digest costs some time
  /// `digest`: of everything before `now`. Return false to end the run without files.
  std::function<bool(Tick now, std::uint64_t digest)> on_mark;
  std::vector<Observer*> observers;  ///< additional observers of all pins; they must outlive the bench
  bool open_ended = false;           ///< `poll` ends the run; expectations for the end are judged then
  bool host = false;                 ///< a master outside the scenario may have slaves, see ExchangeWatch
  bool strict = false;               ///< with a host: its violations fail the run
  bool orders = false;               ///< Bench::order may be called
};

class Bench : private Observer {
 public:
  /// Builds everything; throws InputError. `scenario` must outlive the bench.
  Bench(const scenario::Scenario& scenario, const RunOptions& options, std::unique_ptr<Execution> execution);
  ~Bench();
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  /// Runs to the scenario's end, or until `poll`, called every 100 us of simulated time, returns false. The output
  /// files are complete afterwards.
  RunResult run(const std::function<bool(Tick now)>& poll);
  /// Writes a line into the log for a part outside the bench.
  void log(Tick at, const std::string& station, const std::string& kind, const std::string& text) {
    journal_.log(at, station, kind, text);
  }
  /// With a host: it has sent a telegram too early; it has hung up; its answers, by their start, have no times.
  void host_early(Tick at, const bus::Bytes& telegram) { journal_.host_early(at, telegram, options_.strict); }
  void host_gone() { exchange_.host_gone(); }
  void leave_untimed(std::function<bool(Tick start)> untimed) { monitor_->untimed = std::move(untimed); }
  /// Carries out an action of the script at the next step. `json` and errors: scenario::parse_action.
  void order(const std::string& json);
  /// Passes a command to the user CPU of a slave, which executes it as soon as it can.
  void command(const std::string& slave, const user_cpu::Command& command) {
    stations_.slave(slave).command(now(), command);
  }
  /// The rate of telegrams that no master of the scenario sends. Index of bus/baud.hpp.
  void set_line_baud(int baud) { monitor_->set_baud(baud); }
  /// Adds an observer after all others; it receives what is watched anyway. RunOptions::observers receive all pins,
  /// which costs time.
  void add_observer(Observer& observer) { observers_.add(observer); }
  /// The file in which the log grows until the run ends; empty without a log.
  std::string log_grows_at() const { return journal_.run_log() != nullptr ? journal_.run_log()->grows_at() : ""; }
  /// Makes a sleeping wave (WaveOptions::asleep) follow all pins, see WaveRecorder::wake.
  void wake_wave(Tick from, Tick to);
  /// See WaveRecorder::triggered; null without a sleeping wave.
  const WaveRecorder::Trigger* wave_trigger() const;
  /// Call in a copy of a process that itself continues: of all files it writes only the wave.
  void keep_only_wave();
  /// Removes the unfinished wave; recording stops.
  void drop_wave() { waves_.reset(); }
  /// Ends the run without files.
  void leave_nothing();
  /// There is a wave, but no window of it was opened.
  bool wave_is_empty() const { return waves_ && waves_->is_empty(); }

 private:
  friend class Observers;
  class BaudFollower;

  PinMask watched_pins(const scenario::Slave& slave) const;
  bool needs_all_pins() const;
  bool takes_runs() const;
  void add_slave(const scenario::Slave& slave);
  void connect(MasterStation& entry);
  void add_master(const scenario::Master& spec);
  void add_master2(const scenario::Master2& spec);
  void add_marks();
  void add_monitor();
  void add_answer_faults();
  void add_agents();
  void add_observers();
  const GdbRequest* gdb_of(const scenario::Slave& slave) const;
  user_cpu::OutsideLine* outside_of(const scenario::Slave& slave) const;
  ChipNews wanted_news(const ChipView& chip) const;
  void interrupt(std::size_t slave, Tick at, bool level) override {
    stations_.slaves[slave]->interrupt_changed(at, level);
  }
  void text(std::size_t slave, Tick at, const std::string& line) override;
  void user_failed(std::size_t /*slave*/, Tick /*at*/, const std::string& /*why*/,
                   const std::string& registers) override {
    registers_ = registers;
  }
  void killed() override { periodic_poll_.stop(); }
  void telegram(const HeardTelegram& heard) override;
  bool stopped() const;
  Tick now() const { return execution_->timeline().now(); }
  RunResult collect();
  void add_expectations(RunResult& result);
  SlaveResult collect(SlaveStation& slave, Tick at) const;
  /// A wave that begins late wakes this long before: late reports and a running access have ended by then.
  static constexpr Tick kAwakeBefore = bus::kTicksPerMs;

  Tick sleeps_until() const;
  void marked(Tick now);
  std::uint64_t digest(Tick now);
  /// A debugger goes back: the run must be repeated.
  bool goes_back() const { return options_.gdb && options_.gdb->history && options_.gdb->history->back; }
  bool keep_outputs(Tick at);
  void finish_outputs();

  const scenario::Scenario& scenario_;
  RunOptions options_;
  std::unique_ptr<Execution> execution_;
  Setup setup_;
  Observers observers_;
  ExchangeWatch exchange_;
  CheckWatch checks_;
  HostWatch hosts_;
  Journal journal_;
  Replies replies_;
  Stations stations_;
  std::set<const void*>
      left_out_;  ///< by address in the scenario: parts that a user CPU's program cannot execute or report
  std::unique_ptr<BaudFollower> baud_follower_;
  std::unique_ptr<bus::Monitor> monitor_;
  std::unique_ptr<Script> script_;
  PeriodicPoll periodic_poll_;
  Marks marks_;
  RunDigest digest_;
  bool leaves_nothing_ = false;  ///< of the output files
  bool only_wave_ = false;
  std::optional<PinTrace> trace_;
  std::optional<WaveRecorder> waves_;
  std::optional<CaptureRecorder> capture_;
  std::chrono::steady_clock::time_point next_save_ = {};
  std::string registers_;  ///< of the failed processor, which ends the run
};

}  // namespace dsdpv1::tb
