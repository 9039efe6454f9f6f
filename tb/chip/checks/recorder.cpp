#include "tb/chip/checks/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bus/time_text.hpp"

namespace dsdpv1::checks {

std::string value_text(const Rule& rule, Tick value) {
  return rule.bound == Bound::kMost ? fmt::format("{}", value) : bus::short_time(value);
}

std::string history_text(const Violation& violation) {
  std::string text;
  for (const PinChange& change : violation.history)
    text += fmt::format("{}{}={} {}", text.empty() ? "" : ", ", change.pin->name,
                        tb::level_text(*change.pin, change.level), bus::short_time(change.at - violation.at));
  return text;
}

Tick Recorder::margin(CheckId check, Tick measured) const {
  const Tick limit = limits_[check].value;
  return rule(check).bound == Bound::kMin ? measured - limit : limit - measured;
}

bool Recorder::add(CheckId check, Tick at, Tick measured) {
  Record& record = records_.at(check.index);
  ++record.count;
  const bool limited = limits_[check].value != kNoLimit;
  const Tick left = limited ? margin(check, measured) : 0;
  record.violations += left < 0 ? 1 : 0;
  if (!limited || is_number(check)) {
    if (!record.worst_value || measured > *record.worst_value) {
      record.worst_value = measured;
      record.at = at;
    }
    return left >= 0;
  }
  const std::size_t bin = record.histogram.add(left);
  kept_.at(check.index) = left < 0 ? Kept{} : Kept{measured, bin};
  if (!record.worst_margin || left < *record.worst_margin) {
    record.worst_margin = left;
    record.worst_value = measured;
    record.at = at;
  }
  return left >= 0;
}

bool Recorder::add_outcome(CheckId check, Tick at, bool is_kept) {
  Record& record = records_.at(check.index);
  ++record.count;
  if (is_kept) return true;
  if (record.violations++ == 0) record.at = at;
  return false;
}

void Recorder::report_value(CheckId check, Tick at, Tick measured, const std::string& context, const Act& act) {
  std::string text = fmt::format("{} of {} {}", value_text(rule(check), measured),
                                 rule(check).bound == Bound::kMin ? "at least" : "at most",
                                 value_text(rule(check), limits_[check].value));
  if (!context.empty()) text += ", " + context;
  report(check, at, is_number(check) ? std::nullopt : std::optional(margin(check, measured)), std::move(text), act);
}

void Recorder::report(CheckId check, Tick at, std::optional<Tick> margin, std::string text, const Act& act) {
  if (!on_violation) return;
  const Tick found = std::max({at, now_, history_.now()});
  std::vector<PinChange> history = history_.last(rule(check).pins);
  // The history of a violation found later, by any change, excludes the changes at that time, whose order differs
  // between views.
  const auto is_later = [&](const PinChange& change) { return at < found && change.at >= found; };
  history.erase(std::remove_if(history.begin(), history.end(), is_later), history.end());
  on_violation({check, at, found, margin, std::move(text), std::move(history), act});
}

}  // namespace dsdpv1::checks
