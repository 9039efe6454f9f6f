#include "tb/bench/check_watch.hpp"

#include "tb/bench/chip_view.hpp"

namespace tb {

std::uint32_t CheckWatch::pins() const { return on() ? checks::Checks::kPins | kInputPins : 0; }

void CheckWatch::add(const std::string& slave) {
  if (!on()) return;
  slaves_.push_back(std::make_unique<Slave>(slave, scenario_.checks));
  Slave& entry = *slaves_.back();
  entry.checks.on_violation([this, &entry](const checks::Violation& violation) { violated(entry, violation); });
}

void CheckWatch::telegram(Tick now, const bus::WireTelegram& telegram) {
  for (const auto& slave : slaves_) slave->checks.telegram(now, telegram);
}

void CheckWatch::finish(Tick end) {
  for (const auto& slave : slaves_) slave->checks.finish(end);
}

void CheckWatch::violated(Slave& slave, const checks::Violation& violation) {
  const auto check = static_cast<std::size_t>(violation.check);
  const bool allowed = scenario::allows(scenario_, checks::rule(violation.check).id, slave.name);
  if (allowed) ++slave.allowed.at(check);
  if (mode_ == ChecksMode::kFail && !allowed) ++failures_;
  if (slave.listed_of.at(check)++ < CheckResult::kListed) slave.listed.push_back(violation);
  if (on_violation)
    on_violation(slave.name, violation, mode_ != ChecksMode::kFail ? "check" : allowed ? "allowed" : "violation");
}

std::vector<CheckResult> CheckWatch::results() const {
  std::vector<CheckResult> results;
  for (const auto& slave : slaves_) {
    for (const checks::Check check : checks::kAllChecks) {
      if (!slave->checks.limit(check).on) continue;
      CheckResult result{slave->name,
                         check,
                         slave->checks.limit(check),
                         slave->checks.record(check),
                         slave->allowed.at(static_cast<std::size_t>(check)),
                         {}};
      for (const checks::Violation& each : slave->listed)
        if (each.check == check) result.listed.push_back(each);
      results.push_back(std::move(result));
    }
  }
  return results;
}

}  // namespace tb
