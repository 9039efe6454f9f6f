#include "tb/bench/check_watch.hpp"

#include <utility>

namespace dsdpv1::tb {

PinMask CheckWatch::pins() const { return on() ? scenario_.kind->checked_pins() : 0; }

void CheckWatch::add(const std::string& slave) {
  if (!on()) return;
  const std::size_t rules = scenario_.kind->rules().size();
  slaves_.push_back(std::make_unique<Slave>());
  Slave& entry = *slaves_.back();
  entry.name = slave;
  entry.checks = scenario_.kind->make_checks(scenario_.checks, scenario_.chip.get());
  entry.allowed.resize(rules);
  entry.listed_of.resize(rules);
  entry.checks->on_violation([this, &entry](const checks::Violation& violation) { keep(entry, violation); });
}

void CheckWatch::telegram(const HeardTelegram& telegram) {
  for (const auto& slave : slaves_) slave->checks->telegram(telegram.now, telegram.telegram);
}

void CheckWatch::finish(Tick end) {
  for (const auto& slave : slaves_) slave->checks->finish(end);
}

void CheckWatch::keep(Slave& slave, const checks::Violation& violation) {
  const std::size_t check = violation.check.index;
  const bool allowed = scenario::allows(scenario_, scenario_.kind->rules()[check].id, slave.name);
  if (allowed) ++slave.allowed.at(check);
  if (mode_ == ChecksMode::kFail && !allowed) ++failures_;
  if (slave.listed_of.at(check)++ < CheckResult::kListed) slave.listed.push_back(violation);
  if (on_violation)
    on_violation(slave.name, violation, mode_ != ChecksMode::kFail ? "check" : allowed ? "allowed" : "violation");
}

std::vector<CheckResult> CheckWatch::results() const {
  std::vector<CheckResult> results;
  for (const auto& slave : slaves_) {
    const checks::RuleTable& rules = scenario_.kind->rules();
    for (std::size_t i = 0; i < rules.size(); ++i) {
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
