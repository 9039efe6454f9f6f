#pragma once
// What has happened in a run: counted, kept for the report, written into the log.
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bus/timeline.hpp"
#include "tb/bench/observer.hpp"
#include "tb/bench/record.hpp"
#include "tb/bench/run_log.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

class Journal : public Observer {
 public:
  /// `scenario` and `clock` must outlive it.
  Journal(const scenario::Scenario& scenario, const bus::Timeline& clock, const LogForm& form)
      : scenario_(scenario), clock_(clock), form_(form) {}
  /// From now on there is a log; throws InputError when it cannot be created.
  void open(const std::string& path) { log_.emplace(path, form_); }

  void log(Tick at, const std::string& station, const std::string& kind, const std::string& text) {
    log({at, station, kind, text});
  }
  void log(LogEntry entry);
  /// Bytes as the log shows them inside of a text.
  std::string in_log(const bus::Bytes& bytes) const;
  /// An event of the chip, an error of the program, a flag of the monitor.
  void happened(Occurrence occurrence);
  /// `kind`: "check", "violation" or "allowed".
  void check_violated(const std::string& slave, const checks::Violation& violation, const char* kind);

  // Observer
  void event(std::size_t slave, const profibus::Event& event) override;
  void telegram(const HeardTelegram& telegram) override;
  void host_telegram(std::size_t slave, const HostTelegram& telegram) override;

  /// Told of each code when it is counted; `count`: how often at its station so far. Null: nobody wants to know.
  std::function<void(Tick at, const std::string& station, const std::string& code, bool violation, std::uint64_t count)>
      on_code;

  std::uint64_t count(const std::string& station, const std::string& code) const;
  /// Violations that the scenario does not allow, those of checks apart.
  std::uint64_t violations() const { return violations_; }
  void fill(RunResult& result) const;

  /// Null without a log.
  RunLog* run_log() { return log_ ? &*log_ : nullptr; }
  const RunLog* run_log() const { return log_ ? &*log_ : nullptr; }

 private:
  void count_one(Tick at, const std::string& station, const std::string& code, bool violation);

  const scenario::Scenario& scenario_;
  const bus::Timeline& clock_;
  LogForm form_;
  std::optional<RunLog> log_;
  std::vector<Occurrence> occurrences_;
  std::uint64_t occurrences_dropped_ = 0, violations_ = 0, allowed_ = 0;
  Repetitions refusals_, violated_;
  std::map<std::string, std::map<std::string, std::uint64_t>> counts_;  ///< by station and code
};

}  // namespace dsdpv1::tb
