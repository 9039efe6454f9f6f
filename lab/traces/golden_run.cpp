#include "lab/traces/golden_run.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dsdpv1::tb::traces {

GoldenRun::GoldenRun(const std::string& folder, const scenario::Scenario& scenario, bus::Segment& segment,
                     RunOptions& options) {
  if (folder.empty()) return;
  name_ = golden_name(scenario.file);
  has_firmware_ = names_firmware(scenario);
  golden_ = read_golden(folder, scenario);
  check_.emplace(*golden_.trace, scenario);
  tap_.emplace(scenario, segment);
  tap_->add(*check_);
  options.observers.push_back(&*tap_);
  options.observers.push_back(&*check_);
}

bool GoldenRun::over(Tick now) {
  if (!check_) return false;
  check_->reached(now);
  return check_->done(now);
}

std::string GoldenRun::report() {
  if (!check_) return "";
  check_->finish();
  if (same()) return fmt::format("golden            {}: {} changes are the same\n", name_, check_->same());
  std::string text =
      fmt::format("golden            {}: {} changes are the same, then it differs\n", name_, check_->same());
  text += check_->words();
  if (has_firmware_) text += "firmware          built here, another compiler than the golden's makes other accesses\n";
  return text;
}

}  // namespace dsdpv1::tb::traces
