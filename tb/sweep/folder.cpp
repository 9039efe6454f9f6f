#include "tb/sweep/folder.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <utility>

#include "tb/input/read_file.hpp"
#include "tb/report/output_file.hpp"
#include "tb/scenario/input_error.hpp"
#include "tb/scenario/scenario.hpp"

namespace tb::sweep {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kLastOwnExit = 2;  // above it the run was killed, and is tried again
constexpr const char* kFormat = "dsdpv1-sim sweep 1";

std::string content(const fs::path& path) { return try_read_file(path.string(), kFirmwareFile.most_mb).text; }

/// FNV-1a, 64 bits: tells contents apart, no more.
std::string fingerprint(const std::string& text) {
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3U;
  return fmt::format("{:016x}", hash);
}

Json read_json(const fs::path& path) { return Json::parse(content(path), nullptr, false); }

void write_file(const std::string& path, const std::string& text) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

/// The scenario, the files that it names and those that swept keys name.
Json content_of(const Plan& plan) {
  std::vector<std::string> files = scenario::files(plan.scenario, scenario::parse_settings(plan.settings));
  for (const Parameter& parameter : plan.parameters) {
    if (scenario::field_of(parameter.path, "--param").type.kind != keys::Kind::kFile) continue;
    files.insert(files.end(), parameter.values.begin(), parameter.values.end());
  }
  Json json = {{plan.scenario, fingerprint(scenario::read_file(plan.scenario))}};
  for (const std::string& file : files) json[file] = fingerprint(content(file));
  return json;
}

/// In what `now` is another sweep than `before`.
std::string difference(const Json& before, const Json& now) {
  if (before.value("program", Json()) != now["program"]) return "another version of the program";
  if (before.value("content", Json()) != now["content"]) return "another scenario or other content of its files";
  if (before.value("parameters", Json()) != now["parameters"]) return "other parameters";
  return before == now ? "" : "other settings";
}

/// The first line of what a run wrote to its error channel.
std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

std::string program_identity(const std::string& version) {
  return version + " " + fingerprint(content("/proc/self/exe"));
}

Json identity(const Plan& plan, const std::string& program) {
  Json json = {{"format", kFormat},           {"program", program},        {"scenario", plan.scenario},
               {"content", content_of(plan)}, {"settings", plan.settings}, {"checks", plan.checks},
               {"parameters", Json::array()}};
  for (const Parameter& parameter : plan.parameters)
    json["parameters"].push_back({{"path", parameter.path}, {"values", parameter.values}});
  return json;
}

Folder::Folder(fs::path path, const Json& identity) : path_(std::move(path)) {
  try {
    open(identity);
  } catch (const fs::filesystem_error& error) {
    throw InputError(path_.string(), 0, "cannot be used for a sweep: " + error.code().message());
  }
}

void Folder::open(const Json& identity) {
  if (fs::exists(path_) && !fs::is_directory(path_))
    throw InputError(path_.string(), 0, "is a file, allowed is a folder for the sweep");
  const Json before = fs::exists(path_ / "sweep.json") ? read_json(path_ / "sweep.json") : Json();
  const bool ours = before.is_object() && before.value("format", Json()) == kFormat;
  if (!ours && fs::exists(path_) && !fs::is_empty(path_))
    throw InputError(path_.string(), 0, "holds something else, allowed is a new or empty folder, or one of a sweep");
  if (ours) {
    started_anew_ = difference(before, identity);
    if (!started_anew_.empty()) clear();
  }
  fs::create_directories(path_ / "points");
  if (before != identity) write_file(file("sweep.json"), identity.dump(2) + "\n");
}

/// Only what a sweep writes.
void Folder::clear() const {
  fs::remove_all(path_ / "points");
  fs::remove(path_ / "results.csv");
  for (const auto& entry : fs::directory_iterator(path_)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("map", 0) == 0 && entry.path().extension() == ".svg") fs::remove(entry.path());
  }
}

std::string Folder::point_file(std::size_t point, const char* ending) const {
  return (path_ / "points" / fmt::format("{:05}{}", point, ending)).string();
}

std::optional<Point> Folder::finished(std::size_t point) const {
  const std::string name = point_file(point, ".json");
  if (!fs::exists(name)) return std::nullopt;
  const nlohmann::json kept = nlohmann::json::parse(content(name), nullptr, false);
  const bool ran = !kept.is_discarded() && kept.at("exit") <= kLastOwnExit;
  if (!ran) return std::nullopt;
  return point_of(kept.at("exit"), kept.at("error"), kept.at("result"));
}

Point Folder::finish(std::size_t point, const Plan& plan, int exit) const {
  Json kept = {{"settings", plan.settings_of(point)}, {"exit", exit}, {"error", ""}, {"result", nullptr}};
  if (fs::exists(result_file(point))) {
    kept["result"] = read_json(result_file(point));
  } else {
    kept["error"] = first_line(content(error_file(point)));
  }
  write_file(point_file(point, ".json"), kept.dump() + "\n");
  forget(point);
  return point_of(exit, kept["error"], kept["result"]);
}

void Folder::forget(std::size_t point) const {
  fs::remove(result_file(point));
  fs::remove(error_file(point));
}

}  // namespace tb::sweep
