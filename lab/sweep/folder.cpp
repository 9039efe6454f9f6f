#include "lab/sweep/folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <system_error>

#include "lab/campaign/children.hpp"
#include "lab/campaign/fingerprint.hpp"

namespace dsdpv1::tb::sweep {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

bool is_picture(const std::string& name) {
  return name.rfind("map", 0) == 0 && name.size() > 4 && name.substr(name.size() - 4) == ".svg";
}

bool is_result(const std::string& name) { return name == "results.csv" || is_picture(name); }

/// The difference that makes `now` another sweep than `before`.
std::string difference(const Json& before, const Json& now) {
  if (before.value("program", Json()) != now["program"]) return "another version of the program";
  if (before.value("content", Json()) != now["content"]) return "another scenario or other content of its files";
  if (before.value("parameters", Json()) != now["parameters"]) return "other parameters";
  return before == now ? "" : "other settings";
}

/// The point of a run's result; nullopt for an invalid one. Only these exit codes concern the point, see docs/sweep.md.
std::optional<Point> statement(int exit, const std::string& error, const Json& result) {
  const bool judged = exit == campaign::kPassed || exit == campaign::kFailed || exit == campaign::kNothingJudged;
  const bool ran = judged && error.empty() && result.is_object();
  const bool refused = exit == campaign::kWrongInput && !error.empty() && result.is_null();
  if (!ran && !refused) return std::nullopt;
  return point_of(exit, error, result);
}

std::string name_of(std::size_t point) { return fmt::format("{:05}", point); }

}  // namespace

const campaign::Kind& kind() {
  static const campaign::Kind kind{"sweep", "points", is_result};
  return kind;
}

Json identity(const Plan& plan, const Inputs& inputs, const std::string& program) {
  Json json = {{"format", kind().format()},   {"program", program},        {"scenario", plan.scenario},
               {"content", inputs.content()}, {"settings", plan.settings}, {"checks", plan.checks},
               {"parameters", Json::array()}};
  for (const Parameter& parameter : plan.parameters)
    json["parameters"].push_back({{"path", parameter.path}, {"values", parameter.values}});
  return campaign::as_kept(json);
}

Folder::Folder(const fs::path& path, const Json& identity, Access access)
    : folder_(path, kind(), identity, difference, access),
      identity_(campaign::fingerprint(campaign::text_of(identity))) {}

/// With the id of this process: a surviving run of an earlier owner writes into a separate file.
std::string Folder::result_file(std::size_t point) const {
  return folder_.item_file(fmt::format("{}.{}.run", name_of(point), getpid()));
}

std::optional<Point> Folder::finished(std::size_t point, const Plan& plan) const {
  const Json kept = folder_.kept(name_of(point));
  try {
    if (kept.is_null() || kept.at("identity") != identity_ ||
        kept.at("settings") != campaign::as_kept(plan.settings_of(point)))
      return std::nullopt;
    return statement(kept.at("exit"), kept.at("error"), kept.at("result"));
  } catch (const nlohmann::json::exception&) {  // not of this form
    return std::nullopt;
  }
}

std::optional<Point> Folder::finish(std::size_t point, const Plan& plan, int exit, const std::string& error) const {
  const Json result = exit == campaign::kWrongInput ? Json() : campaign::read_json(result_file(point));
  forget(point);
  try {
    if (!statement(exit, error, result)) return std::nullopt;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
  const Json kept = folder_.keep(name_of(point), {{"identity", identity_},
                                                  {"settings", plan.settings_of(point)},
                                                  {"exit", exit},
                                                  {"error", error},
                                                  {"result", result}});
  return statement(exit, kept["error"], result);
}

void Folder::forget(std::size_t point) const {
  std::error_code ignored;  // the next owner of the folder removes it
  fs::remove(result_file(point), ignored);
}

}  // namespace dsdpv1::tb::sweep
