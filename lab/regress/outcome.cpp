#include "lab/regress/outcome.hpp"

#include <fmt/format.h>

#include <array>
#include <cstring>

#include "lab/campaign/jobs.hpp"
#include "lab/sweep/point.hpp"

namespace dsdpv1::tb::regress {
namespace {

using campaign::Ended;
using campaign::Json;

constexpr std::array<const char*, 7> kNames = {"passed",  "failed", "nothing_judged", "refused",
                                               "crashed", "hung",   "not_run"};

Verdict verdict_of(const Ended& ended) {
  if (ended.too_long) return Verdict::kHung;
  if (ended.exit > campaign::kSignalled) return Verdict::kCrashed;
  if (ended.exit == campaign::kPassed) return Verdict::kPassed;
  if (ended.exit == campaign::kNothingJudged) return Verdict::kNothingJudged;
  return ended.exit == campaign::kWrongInput ? Verdict::kRefused : Verdict::kFailed;
}

std::string first_unmet(const Json& result) {
  for (const Json& each : result.at("expectations"))
    if (each.at("passed") == false)
      return fmt::format("not met: {}; seen: {}", each.at("text").get<std::string>(),
                         each.at("seen").get<std::string>());
  return "";
}

/// The pin or cell and both values; empty when the output has no difference of model and RTL.
std::string difference(const std::string& output) {
  const std::size_t begin = output.find("first difference  "), end = output.find('\n', begin);
  if (begin == std::string::npos || end == std::string::npos) return "";
  const std::size_t what = output.find_first_not_of(' ', end + 1);
  return what == std::string::npos ? "" : output.substr(what, output.find('\n', what) - what);
}

/// The reason of a failed run.
std::string failure(const Ended& ended, const Json& result) {
  try {
    std::string differs = difference(ended.output);
    if (!differs.empty()) return differs;
    std::string unmet = first_unmet(result);
    if (!unmet.empty()) return unmet;
    const sweep::Point point = sweep::point_of(ended.exit, "", result);
    if (result.at("passed") == false) return point.reason();
  } catch (const nlohmann::json::exception&) {  // not a result, or not of this form
    return fate(ended);
  }
  return ended.output.substr(0, ended.output.find('\n'));
}

std::string reason_of(Verdict verdict, const Ended& ended, const Json& result) {
  switch (verdict) {
    case Verdict::kPassed:
    case Verdict::kNotRun: return "";
    case Verdict::kHung: return fmt::format("still ran after {:.1f} s and was killed", ended.seconds);
    case Verdict::kCrashed: {
      const int signal = ended.exit - campaign::kSignalled;
      const char* const abbreviation = sigabbrev_np(signal);
      return fmt::format("killed by signal {} (SIG{})", signal, abbreviation != nullptr ? abbreviation : "?");
    }
    case Verdict::kRefused: return fate(ended);
    case Verdict::kFailed:
    case Verdict::kNothingJudged: return failure(ended, result);
  }
  return "";
}

void count(Json& counts, const Json& code, std::uint64_t times) {
  Json& sum = counts[code.get<std::string>()];
  sum = (sum.is_null() ? 0 : sum.get<std::uint64_t>()) + times;
}

/// A scenario has a list of events, which may be cut, and sums of refusals and violations.
Json codes_of_scenario(const Json& result) {
  Json codes = Json::object();
  for (const Json& event : result.at("events"))
    if (event.at("severity") == "info") count(codes, event.at("code"), 1);
  for (const char* list : {"refused", "violated"})
    for (const Json& each : result.at(list)) count(codes, each.at("code"), each.at("count"));
  return codes;
}

Json without_zeros(const Json& counts) {
  Json some = Json::object();
  for (const auto& [name, times] : counts.items())
    if (times != 0) some[name] = times;
  return some;
}

Verdict verdict_named(const std::string& text) {
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (text == kNames[i]) return static_cast<Verdict>(i);
  throw nlohmann::json::other_error::create(0, "no verdict", static_cast<const Json*>(nullptr));
}

}  // namespace

const char* name(Verdict verdict) { return kNames.at(static_cast<std::size_t>(verdict)); }

Outcome not_run(const std::string& reason) {
  Outcome outcome;
  outcome.verdict = Verdict::kNotRun;
  outcome.reason = reason;
  return outcome;
}

Outcome outcome_of(const Ended& ended, const Json& result) {
  Outcome outcome;
  outcome.verdict = verdict_of(ended);
  outcome.exit = ended.exit;
  outcome.seconds = ended.seconds;
  outcome.reason = reason_of(outcome.verdict, ended, result);
  if (!outcome.passed()) outcome.output = ended.output;
  return outcome;
}

Json seen_of(const Json& result) {
  try {
    if (!result.contains("coverage")) return {{"codes", codes_of_scenario(result)}, {"situations", Json::object()}};
    const Json& coverage = result.at("coverage");
    Json situations = Json::object();
    for (const auto& [group, counts] : coverage.at("situations").items()) situations[group] = without_zeros(counts);
    return {{"codes", without_zeros(coverage.at("codes"))}, {"situations", situations}};
  } catch (const nlohmann::json::exception&) {  // there is none
    return nullptr;
  }
}

Json json_of(const Outcome& outcome) {
  return {{"verdict", name(outcome.verdict)},
          {"exit", outcome.exit},
          {"seconds", outcome.seconds},
          {"reason", outcome.reason},
          {"output", outcome.output},
          {"log", outcome.log},
          {"files", outcome.files}};
}

Outcome outcome_of(const Json& json) {
  return {verdict_named(json.at("verdict")),
          json.at("exit"),
          json.at("seconds"),
          json.at("reason"),
          json.at("output"),
          json.at("log"),
          json.at("files").get<std::vector<std::string>>()};
}

}  // namespace dsdpv1::tb::regress
