#include "lab/sweep/point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bus/time_text.hpp"
#include "lab/campaign/children.hpp"
#include "tb/report/result_fields.hpp"

namespace dsdpv1::tb::sweep {
namespace {

using Json = nlohmann::json;

void take_first(std::optional<FirstViolation>& first, const FirstViolation& seen) {
  if (!first || seen.at_ns < first->at_ns) first = seen;
}

void take_events(Point& point, const Json& run) {
  for (const Json& event : run.value("events", Json::array())) {
    if (event.at("severity") != "violation" || event.at("allowed") == true) continue;
    take_first(point.first, {event.at("at_ns"), event.at("slave"), event.at("code"), text_and_place(event)});
  }
}

CheckSeen& check_named(std::vector<CheckSeen>& checks, const std::string& id) {
  const auto found = std::find_if(checks.begin(), checks.end(), [&id](const CheckSeen& each) { return each.id == id; });
  if (found != checks.end()) return *found;
  checks.push_back({id, 0, 0, std::nullopt});
  return checks.back();
}

void take_check(Point& point, const Json& json) {
  CheckSeen& check = check_named(point.checks, json.at("id"));
  check.count += json.value("count", std::int64_t{0});
  const Json margin = json.value("worst_margin_ns", Json());
  if (margin.is_number()) check.margin_ns = std::min(check.margin_ns.value_or(margin), margin.get<double>());
  const std::int64_t violations = json.value("violations", std::int64_t{0}) - json.value("allowed", std::int64_t{0});
  if (violations <= 0) return;
  check.violations += violations;
  for (const Json& each : json.value("listed", Json::array()))
    take_first(point.first, {each.at("at_ns"), json.value("slave", ""), check.id, text_and_place(each)});
}

void take_run(Point& point, const Json& run) {
  point.violations = run.at("violations");
  for (const Json& slave : run.at("slaves"))
    point.bad_reads += slave.at("user_cpu").at("bad_reads").get<std::int64_t>();
  take_events(point, run);
  for (const Json& check : run.value("checks", Json::array())) take_check(point, check);
  for (const Json& each : run.at("expectations"))
    if (point.unmet.empty() && each.at("passed") == false) point.unmet = each.at("text");
}

}  // namespace

bool Point::holds() const {
  const auto kept = [](const CheckSeen& check) { return check.violations == 0; };
  return exit == 0 && violations == 0 && bad_reads == 0 && std::all_of(checks.begin(), checks.end(), kept);
}

const CheckSeen* Point::check(const std::string& id) const {
  const auto found = std::find_if(checks.begin(), checks.end(), [&id](const CheckSeen& each) { return each.id == id; });
  return found == checks.end() ? nullptr : &*found;
}

const CheckSeen* Point::worst() const {
  const CheckSeen* worst = nullptr;
  for (const CheckSeen& check : checks)
    if (check.margin_ns && (worst == nullptr || *check.margin_ns < *worst->margin_ns)) worst = &check;
  return worst;
}

std::string Point::reason() const {
  if (holds()) return "";
  if (!error.empty()) return error;
  const std::string bad = bad_reads != 0 ? fmt::format("{} reads of unknown data", bad_reads) : "";
  const std::string seen =
      first ? fmt::format("{} at {}: {}", first->code, bus::moment_text(std::llround(first->at_ns * bus::kTicksPerNs)),
                          first->text)
            : "";
  if (!bad.empty() || !seen.empty()) return bad + (bad.empty() || seen.empty() ? "" : "; ") + seen;
  if (exit == campaign::kNothingJudged) return "nothing was judged: no data exchange, and nothing was expected";
  return unmet.empty() ? fmt::format("exit code {}", exit) : "not met: " + unmet;
}

Point point_of(int exit, const std::string& error, const Json& run) {
  Point point;
  point.exit = exit;
  point.error = error;
  if (!run.is_null()) take_run(point, run);
  return point;
}

}  // namespace dsdpv1::tb::sweep
