#pragma once
// Compares a run with its golden while it runs.
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lab/traces/tap.hpp"
#include "lab/traces/trace.hpp"
#include "tb/bench/observer.hpp"

namespace dsdpv1::tb::traces {

/// A signal of one side at the tick of the difference.
struct Side {
  Level level = kLevelX;  ///< at that tick
  bool changed = false;   ///< changed to it at this tick
};

struct Difference {
  Tick at = 0;
  Signal signal;
  Side golden, here;
};

/// "pin READY of io: golden 0, here still 1", "the line: golden still 1, here 0".
std::string what_differs(const Difference& difference);

/// Gets all signals from a Tap, and telegrams as an Observer. Compares up to the first difference: at each tick every
/// signal must change as often and to the same levels as in the golden. The order of signals within one tick does not
/// matter.
class GoldenCheck : public Sink, public Observer {
 public:
  /// Both must outlive it. The signals of the trace are those of the scenario.
  GoldenCheck(const Trace& golden, const scenario::Scenario& scenario);

  void change(std::size_t signal, Tick at, Level level) override;
  void telegram(const HeardTelegram& heard) override;

  /// All changes before `now` were reported.
  void reached(Tick now);
  /// The run has ended, all changes were reported.
  void finish() { reached(bus::kNever); }

  const std::optional<Difference>& difference() const { return difference_; }
  /// `words` is complete: the telegram at the difference has ended as well.
  bool done(Tick now) const { return difference_ && (heard_all_ || now > difference_->at + longest_telegram_); }
  /// The first difference in some lines: time, signal and levels, telegram, access.
  std::string words() const;
  /// Number of equal changes, without the levels of power-on.
  std::uint64_t same() const { return matched_ - std::min<std::uint64_t>(matched_, cursors_.size()); }

 private:
  struct Wrong {
    std::size_t signal;
    Level before, after;
  };
  bool is_wrong(std::size_t signal) const;
  bool matches(std::size_t signal, Tick at, Level level);
  Tick earliest() const;
  void settle();
  void find(Tick at, std::size_t signal, const Side& golden, const Side& here);
  void note_access(std::size_t signal, Tick at, Level level);
  std::string telegram_words() const;

  const Trace& golden_;
  std::vector<Cursor> cursors_;
  std::vector<Tick> next_;     ///< of each cursor
  std::vector<Level> levels_;  ///< present levels of the signals
  std::vector<Wrong> wrong_;   ///< the first change of a signal at now_ that the golden does not have
  Tick now_ = 0;               ///< tick of the last reported changes
  std::uint64_t matched_ = 0;
  std::optional<Difference> difference_;

  SignalNumbers numbers_;
  std::vector<std::unique_ptr<AccessReader>> accesses_;  ///< by slave
  std::string access_;                                   ///< last access of the slave's user before the difference
  Tick longest_telegram_;
  std::optional<bus::WireTelegram> heard_;  ///< the last one begun before the difference
  bool heard_all_ = false;                  ///< a telegram has ended after it
};

}  // namespace dsdpv1::tb::traces
