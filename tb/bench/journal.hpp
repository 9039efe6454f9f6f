#pragma once
// The events of a run: counted, kept for the report, written into the log.
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tb/bench/observer.hpp"
#include "tb/bench/record.hpp"
#include "tb/bench/run_log.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

class Journal : public Observer {
 public:
  /// `scenario` and `observers`, which receive each counted code, must outlive it.
  Journal(const scenario::Scenario& scenario, const Observers& observers, const LogForm& form)
      : scenario_(scenario), observers_(observers), form_(form) {}
  /// Starts a log; throws InputError if it cannot be created.
  void open(const std::string& path) { log_.emplace(path, form_); }

  void log(Tick at, const std::string& station, const std::string& kind, const std::string& text) {
    log({at, station, kind, text});
  }
  void log(LogEntry entry);
  /// Bytes as shown inside a text of the log.
  std::string in_log(const bus::Bytes& bytes) const;

  // Observer
  void event(std::size_t slave, const profibus::Event& event) override;
  void telegram(const HeardTelegram& telegram) override;
  void violated(const std::string& slave, const checks::Violation& violation, const char* kind) override;
  void flag(const bus::Flag& flag) override;
  void host_telegram(std::size_t slave, const HostTelegram& telegram) override;
  void error(std::size_t slave, const user_cpu::ProgramError& error) override;
  void text(std::size_t slave, Tick at, const std::string& line) override { log(at, name_of(slave), "text", line); }
  void outputs(std::size_t slave, Tick at, const bus::Bytes& outputs, bool changed) override;
  void user_failed(std::size_t slave, Tick at, const std::string& why, const std::string& registers) override;

  /// serve's host has sent this telegram too early; `judged`: it fails the run.
  void host_early(Tick at, const bus::Bytes& telegram, bool judged);

  std::uint64_t count(const std::string& station, const std::string& code) const;
  /// Violations that the scenario does not allow, without those of checks.
  std::uint64_t violations() const { return violations_; }
  void fill(RunResult& result) const;

  /// Null without a log.
  RunLog* run_log() { return log_ ? &*log_ : nullptr; }
  const RunLog* run_log() const { return log_ ? &*log_ : nullptr; }

 private:
  const std::string& name_of(std::size_t slave) const { return scenario_.slaves[slave].name.text; }
  const ChipKind& kind_of(std::size_t slave) const { return *scenario_.slaves[slave].kind; }

  /// Repetitions at one station, with one code, at one place: found once, then only counted.
  struct Tally {
    Occurrence sample;               ///< without time and words
    std::uint64_t* count = nullptr;  ///< in counts_
    Repeated* repeated = nullptr;    ///< of a refusal or a violation
  };
  /// That of an event of a chip; `slave`, reason and numbers say which one it is.
  struct EventTally {
    std::size_t slave;
    profibus::Event event;
    Tally tally;
    bool is_of(std::size_t other, const profibus::Event& another) const;
  };
  Tally tally(const std::string& station, const std::string& code, profibus::Severity severity,
              const std::string& place = {}, bool judged = true);
  const Tally& tally(std::size_t slave, const profibus::Event& event);
  /// Room in the result's list of events.
  bool lists() const { return kept_.size() < RunResult::kKept; }
  void count(const Tally& tally, Tick at);
  bool is_only_counted(const Tally& tally) const;
  void count_again(const Tally& tally, Tick at);
  /// An event of a chip of this kind, or nothing.
  struct OfChip {
    const ChipKind* kind = nullptr;
    const profibus::Event* event = nullptr;
  };
  /// An error of the program, a flag of the monitor; or one of the chip, whose text is made on demand. `where()` gives
  /// the place of the user's act; it is asked only when it is listed or logged.
  template <class Where>
  void happened(const Tally& tally, Tick at, const std::string& text, const OfChip& chip, const Where& where);

  const scenario::Scenario& scenario_;
  const Observers& observers_;
  LogForm form_;
  std::optional<RunLog> log_;
  struct Kept {
    Occurrence occurrence;
    const ChipKind* kind;
    std::optional<profibus::Event> event;  ///< its text has not been made yet
  };
  std::vector<Kept> kept_;
  std::uint64_t occurrences_dropped_ = 0, violations_ = 0, allowed_ = 0, unjudged_ = 0;
  Repetitions refusals_, violated_;
  std::map<std::string, std::map<std::string, std::uint64_t>> counts_;  ///< by station and code
  std::array<std::optional<EventTally>, 64> tallies_;                   ///< of the last events
};

}  // namespace dsdpv1::tb
