#pragma once
// Collects the findings of the checks: counts, worst margins, histograms, and the violations as text.
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tb/chip/checks/check.hpp"
#include "tb/chip/checks/histogram.hpp"
#include "tb/chip/checks/pin_history.hpp"
#include "tb/chip/user_cpu/place.hpp"

namespace dsdpv1::checks {

using user_cpu::Act;

/// The results of a check so far. Values and margins are ticks of 1/12 ns; values of Bound::kMost are numbers.
struct Record {
  std::uint64_t count = 0;       ///< how often it was evaluated
  std::uint64_t violations = 0;  ///< how often it failed
  std::optional<Tick>
      worst_margin;                 ///< the least one, positive = kept; absent without a limit, and for kRule and kMost
  std::optional<Tick> worst_value;  ///< measured then; without a limit and for kMost the greatest one
  std::optional<Tick> at;           ///< when that was; for Bound::kRule the first violation
  Histogram histogram;              ///< of margins
};

struct Violation {
  CheckId check;
  Tick at = 0;     ///< when the rule was broken
  Tick found = 0;  ///< when that became visible, not before `at`
  std::optional<Tick> margin;
  std::string text;
  std::vector<PinChange> history;             ///< the last changes of the pins that the check concerns
  Act act;                                    ///< the user's, by which it broke the rule, or its omission
  std::optional<user_cpu::Place> where = {};  ///< of the act in the user's program, if that is known
};

/// A value of a check: "62.500 ns", or "12".
std::string value_text(const Rule& rule, Tick value);

/// "SCK=1 -62.500 ns, XSS=1 0.000 ns": the violation's history, with times relative to it.
std::string history_text(const Violation& violation);

class Recorder {
 public:
  /// `rules` and `history` must outlive it.
  Recorder(const RuleTable& rules, Limits limits, const PinHistory& history)
      : rules_(rules), limits_(std::move(limits)), history_(history), records_(rules.size()), kept_(rules.size()) {}

  /// A value of a check with Bound::kMin, kMax or kMost; `context()` describes the case, called only for a violation.
  /// `act`: of the user, if not at `at`; Act::omitted if the user should have done something.
  template <class Context>
  void value(CheckId check, Tick at, Tick measured, const Context& context, const std::optional<Act>& act = {}) {
    if (!limits_[check].on || repeats(check, measured)) return;
    if (!add(check, at, measured)) report_value(check, at, measured, context(), act.value_or(Act::done(at)));
  }
  /// The outcome of a check with Bound::kRule; `text()` describes the violation. `act`: as above.
  template <class Text>
  void kept(CheckId check, Tick at, bool is_kept, const Text& text, const std::optional<Act>& act = {}) {
    if (limits_[check].on && !add_outcome(check, at, is_kept))
      report(check, at, std::nullopt, text(), act.value_or(Act::done(at)));
  }

  const Record& record(CheckId check) const { return records_.at(check.index); }
  const Limit& limit(CheckId check) const { return limits_[check]; }
  /// The limit from now on, where it depends on the run.
  void set_limit(CheckId check, Tick limit) {
    limits_[check].value = limit;
    kept_.at(check.index) = {};  // of the limit before
  }
  /// Time advances without a change of a pin (a telegram, the end of the run).
  void now(Tick at) { now_ = at; }

  std::function<void(const Violation&)> on_violation;

 private:
  /// The value measured last, if it has a limit and kept it.
  struct Kept {
    std::optional<Tick> measured;
    std::size_t bin = 0;  ///< of its margin
  };
  /// Most accesses have the same timing: the same value again is only counted.
  bool repeats(CheckId check, Tick measured) {
    const Kept& last = kept_.at(check.index);
    if (last.measured != measured) return false;
    Record& record = records_.at(check.index);
    ++record.count;
    record.histogram.count_in(last.bin);
    return true;
  }
  bool add(CheckId check, Tick at, Tick measured);
  bool add_outcome(CheckId check, Tick at, bool is_kept);
  void report_value(CheckId check, Tick at, Tick measured, const std::string& context, const Act& act);
  void report(CheckId check, Tick at, std::optional<Tick> margin, std::string text, const Act& act);
  Tick margin(CheckId check, Tick measured) const;
  bool is_number(CheckId check) const { return rule(check).bound == Bound::kMost; }
  const Rule& rule(CheckId check) const { return rules_.at(check.index); }

  const RuleTable& rules_;
  Limits limits_;
  const PinHistory& history_;
  Tick now_ = 0;
  std::vector<Record> records_;
  std::vector<Kept> kept_;  ///< by check
};

}  // namespace dsdpv1::checks
