#pragma once
// A scenario carried out: builds the stations, runs the timeline, collects what happened. The script is in script.hpp,
// the judging of conditions in conditions.hpp.
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bus/master/master1.hpp"
#include "bus/monitor/monitor.hpp"
#include "tb/bench/check_watch.hpp"
#include "tb/bench/class2_station.hpp"
#include "tb/bench/execution.hpp"
#include "tb/bench/periodic_poll.hpp"
#include "tb/bench/pin_trace.hpp"
#include "tb/bench/record.hpp"
#include "tb/bench/reply.hpp"
#include "tb/bench/run_log.hpp"
#include "tb/bench/setup.hpp"
#include "tb/bench/slave_station.hpp"
#include "tb/bench/wave_recorder.hpp"
#include "tb/scenario/scenario.hpp"

namespace tb {

class Script;

struct RunOptions {
  Engine engine = Engine::kSkip;
  std::string engine_name = "skip", view_name = "pins";
  std::string wave, log, trace;   ///< paths, empty: not wanted
  bool log_whole = false;         ///< no bytes are left out in the log
  std::optional<GdbRequest> gdb;  ///< debugger of the first user CPU that takes one
  std::function<void(const std::string& station, const std::string& line)> on_text;  ///< what user CPUs print
  ChecksMode checks = ChecksMode::kOff;
  bool open_ended = false;  ///< the run ends when `poll` says so, and what is to be judged at the end is judged then
};

class Bench {
 public:
  /// Builds everything; throws InputError. `scenario` must outlive the bench.
  Bench(const scenario::Scenario& scenario, const RunOptions& options, std::unique_ptr<Execution> execution);
  ~Bench();
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  /// Runs to the scenario's end, or until `poll`, which is called every 100 us of simulated time, returns false. The
  /// files of the options are complete afterwards.
  RunResult run(const std::function<bool(Tick now)>& poll);
  /// Where the log grows until the run ends; empty without a log.
  std::string log_grows_at() const { return log_ ? log_->grows_at() : ""; }

  // --- For the script and the conditions.
  const scenario::Scenario& scenario() const { return scenario_; }
  Tick now() const { return execution_->timeline().now(); }
  SlaveStation& slave(const std::string& name) { return *find_slave(name); }
  const SlaveStation& slave(const std::string& name) const { return *find_slave(name); }
  /// The first one for an empty name.
  bus::Master1& master(const std::string& name);
  /// The class 2 master with this name, null when there is none; and the one that has this connection.
  Class2Station* class2(const std::string& name);
  Class2Station& owner_of(const std::string& connection);
  const bus::Connection& connection(const std::string& name) const;
  bus::Segment& segment() { return execution_->segment(); }
  /// The master that exchanges data with a slave, null when none does.
  const bus::Master1* master_of(const std::string& slave) const;
  /// What masters call the slave: the address in their lists.
  std::optional<std::uint8_t> listed_address(const std::string& slave) const;
  /// Whether an action or expectation of the scenario is left out, see untold.hpp.
  bool leaves_out(const void* what) const { return left_out_.count(what) != 0; }
  std::uint64_t count(const std::string& slave, const std::string& code) const;
  /// `asker`: the master's name as the script gives it, or a connection's.
  const Reply* last_reply(const std::string& asker, scenario::ActionKind service) const;
  void keep_reply(const std::string& asker, scenario::ActionKind service, Reply reply);
  void connection_changed(const std::string& master, const std::string& connection, const std::string& state);
  void change_baud(int index);
  void log(Tick at, const std::string& station, const std::string& kind, const std::string& text);
  void log(LogEntry entry);
  /// Bytes as the log shows them inside of a text.
  std::string in_log(const bus::Bytes& bytes) const;
  /// Something has changed: conditions are looked at again in this tick.
  void conditions_changed();
  void conditions_changed(Tick at);

 private:
  struct Master {
    const scenario::Master* spec = nullptr;
    std::unique_ptr<bus::Master1> master;
    std::map<std::uint8_t, std::string> slaves;  ///< names by address
  };
  class BaudFollower;

  PinMask watched_pins() const;
  const std::unique_ptr<SlaveStation>& find_slave(const std::string& name) const;
  void add_slave(const scenario::Slave& slave);
  void connect(SlaveStation& station, std::size_t index);
  void connect(Master& entry);
  void add_master(const scenario::Master& spec);
  void add_master2(const scenario::Master2& spec);
  void add_monitor();
  void add_agents();
  void begin_waves();
  void pin_changed(std::size_t index, Tick at, PinNumber pin, Level level);
  void chip_event(std::size_t index, const profibus::Event& event);
  const GdbRequest* gdb_of(const scenario::Slave& slave) const;
  void user_failed(const SlaveStation& station, Tick at, const std::string& why, const std::string& registers);
  bool stopped() const;
  void check_violated(const std::string& slave, const checks::Violation& violation, const char* kind);
  void program_error(const SlaveStation& station, const user_cpu::ProgramError& error);
  void telegram(const bus::WireTelegram& telegram);
  void flagged(const bus::Flag& flag);
  void happened(Occurrence occurrence);
  RunResult collect();
  bool keep_outputs(Tick at);
  void finish_outputs();

  const scenario::Scenario& scenario_;
  const ChipMaker& maker_;
  RunOptions options_;
  std::unique_ptr<Execution> execution_;
  Setup setup_;
  CheckWatch checks_;
  std::set<const void*> left_out_;
  std::vector<std::unique_ptr<SlaveStation>> slaves_;
  std::vector<Master> masters_;
  std::vector<std::unique_ptr<Class2Station>> masters2_;
  std::unique_ptr<BaudFollower> baud_follower_;
  std::unique_ptr<bus::Monitor> monitor_;
  std::unique_ptr<Script> script_;
  PeriodicPoll periodic_poll_;
  LogForm log_form_;
  std::optional<RunLog> log_;
  std::optional<PinTrace> trace_;
  std::optional<WaveRecorder> waves_;
  std::chrono::steady_clock::time_point next_save_ = {};

  std::vector<Occurrence> occurrences_;
  std::uint64_t occurrences_dropped_ = 0, violations_ = 0;
  Refusals refusals_;
  std::string registers_;  ///< of the processor that cannot go on; the run ends with it
  std::map<std::string, std::map<std::string, std::uint64_t>> counts_;    ///< by station and code
  std::map<std::string, std::map<scenario::ActionKind, Reply>> replies_;  ///< by master and service
};

}  // namespace tb
