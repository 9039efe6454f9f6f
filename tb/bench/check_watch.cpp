#include "tb/bench/check_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/input/input_error.hpp"

namespace dsdpv1::tb {

namespace {

/// Rejects conditions on checks that are switched off: they would always be false, or always true.
void refuse_unmade(const scenario::Scenario& scenario, ChecksMode mode, const scenario::Condition& condition) {
  const ChipKind& kind =
      condition.slave.empty() ? *scenario.kind : *scenario.slaves[slave_number(scenario, condition.slave.text)].kind;
  const checks::RuleTable& rules = kind.rules();
  const auto rule = std::find_if(rules.begin(), rules.end(),
                                 [&](const checks::Rule& each) { return condition.event.text == each.id; });
  if (rule == rules.end()) return;
  const bool made =
      &kind != scenario.kind || scenario.checks[checks::CheckId(static_cast<std::size_t>(rule - rules.begin()))].on;
  if (mode != ChecksMode::kOff && made) return;
  throw InputError(scenario.file, condition.line,
                   fmt::format("{} is a check, which is off, expected {}", rule->id,
                               made ? "mode fail or report (--checks, checks: {mode})" : "enabled: true"));
}

}  // namespace

CheckWatch::CheckWatch(const scenario::Scenario& scenario, ChecksMode mode, const Observers& observers)
    : scenario_(scenario),
      mode_(mode),
      observers_(observers),
      on_(mode != ChecksMode::kOff &&
          std::any_of(scenario.slaves.begin(), scenario.slaves.end(),
                      [](const scenario::Slave& slave) { return !slave.kind->rules().empty(); })) {
  for (const scenario::Expectation& each : scenario.expect) refuse_unmade(scenario, mode, each);
  for (const scenario::Action& each : scenario.script)
    if (each.when) refuse_unmade(scenario, mode, *each.when);
}

PinMask CheckWatch::pins(const scenario::Slave& slave) const { return on() ? slave.kind->checked_pins() : 0; }

void CheckWatch::add(const scenario::Slave& slave, ChipView& chip) {
  if (!on()) return;
  const checks::RuleTable& rules = slave.kind->rules();
  slaves_.push_back(std::make_unique<Slave>());
  Slave& entry = *slaves_.back();
  entry.number = slaves_.size() - 1;
  entry.name = slave.name.text;
  entry.rules = &rules;
  entry.chip = &chip;
  entry.checks = slave.kind->make_checks(scenario::limits_of(scenario_, *slave.kind), slave.chip.get());
  if (entry.checks == nullptr) return;
  entry.allowed.resize(rules.size());
  entry.listed_of.resize(rules.size());
  if (chip.tells_looks()) entry.checks->hears_looks();
  entry.checks->on_violation([this, &entry](const checks::Violation& violation) { keep(entry, violation); });
}

void CheckWatch::telegram(const HeardTelegram& telegram) {
  for (const auto& slave : slaves_)
    if (slave->checks != nullptr) slave->checks->telegram(telegram.now, telegram.telegram);
}

void CheckWatch::finish(Tick end) {
  for (const auto& slave : slaves_)
    if (slave->checks != nullptr) slave->checks->finish(end);
}

void CheckWatch::keep(Slave& slave, checks::Violation violation) {
  violation.where = observers_.where(slave.number, violation.act);
  const std::size_t check = violation.check.index;
  const bool allowed = scenario::allows(scenario_, (*slave.rules)[check].id, slave.name);
  if (allowed) ++slave.allowed.at(check);
  if (mode_ == ChecksMode::kFail && !allowed) ++failures_;
  if (slave.listed_of.at(check)++ < CheckResult::kListed) slave.listed.push_back(violation);
  slave.chip->pause_access();
  const char* const kind = mode_ != ChecksMode::kFail ? "check" : allowed ? "allowed" : "violation";
  observers_.tell(&Observer::violated, slave.name, violation, kind);
  observers_.changed(violation.found);
}

std::uint64_t CheckWatch::left_out() const {
  const auto own = std::find_if(slaves_.begin(), slaves_.end(),
                                [this](const auto& slave) { return slave->rules == &scenario_.kind->rules(); });
  if (own == slaves_.end() || (*own)->checks == nullptr) return 0;
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < (*own)->rules->size(); ++i) {
    const checks::CheckId check(i);
    if ((*own)->checks->applies(check) && !(*own)->checks->limit(check).on) ++count;
  }
  return count;
}

std::vector<CheckResult> CheckWatch::results() const {
  std::vector<CheckResult> results;
  for (const auto& slave : slaves_) {
    const checks::RuleTable& rules = *slave->rules;
    for (std::size_t i = 0; slave->checks != nullptr && i < rules.size(); ++i) {
      const checks::CheckId check(i);
      if (!slave->checks->limit(check).on || !slave->checks->applies(check)) continue;
      CheckResult result{slave->name,          &rules[i], slave->checks->limit(check), slave->checks->record(check),
                         slave->allowed.at(i), {}};
      for (const checks::Violation& each : slave->listed)
        if (each.check.index == i) result.listed.push_back(each);
      results.push_back(std::move(result));
    }
  }
  return results;
}

}  // namespace dsdpv1::tb
