#include "tb/sweep/folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "tb/input/input_error.hpp"
#include "tb/output/output_file.hpp"
#include "tb/sweep/fingerprint.hpp"

namespace tb::sweep {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kPassed = 0, kFailed = 1, kWrongInput = 2;
constexpr const char* kFormat = "dsdpv1-sim sweep 1";

Json read_json(const fs::path& path) { return Json::parse(content(path.string()), nullptr, false); }

void write_file(const std::string& path, const std::string& text) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

bool begins_with(const std::string& text, const std::string& part) { return text.rfind(part, 0) == 0; }

bool is_picture(const std::string& name) {
  return begins_with(name, "map") && name.size() > 4 && name.substr(name.size() - 4) == ".svg";
}

/// A file that a sweep leaves beside its points.
bool is_result(const std::string& name) { return name == "sweep.json" || name == "results.csv" || is_picture(name); }

/// A temporary name of a file that a sweep writes: left by one that was killed.
bool is_left_over(std::string name) {
  if (begins_with(name, ".")) name.erase(0, 1);
  const bool ours = begins_with(name, "sweep.json") || begins_with(name, "results.csv") ||
                    (begins_with(name, "map") && name.find(".svg") != std::string::npos);
  return ours && name.find(".part") != std::string::npos;
}

/// "00042.4711.run", "00042.json.4711.part": what a run that is no more has left in the folder of the points.
bool is_remainder(const std::string& name) {
  const std::size_t digits = name.find_first_not_of("0123456789");
  const std::string ending = name.substr(name.rfind('.') + 1);
  return digits != 0 && digits != std::string::npos && name[digits] == '.' &&
         (ending == "run" || ending == "err" || ending == "part");
}

/// In what `now` is another sweep than `before`.
std::string difference(const Json& before, const Json& now) {
  if (before.value("program", Json()) != now["program"]) return "another version of the program";
  if (before.value("content", Json()) != now["content"]) return "another scenario or other content of its files";
  if (before.value("parameters", Json()) != now["parameters"]) return "other parameters";
  return before == now ? "" : "other settings";
}

/// What the result of a run says; nullopt when it is no result. Only these exit codes are about the point, see
/// docs/sweep.md.
std::optional<Point> statement(int exit, const std::string& error, const Json& result) {
  const bool ran = (exit == kPassed || exit == kFailed) && error.empty() && result.is_object();
  const bool refused = exit == kWrongInput && !error.empty() && result.is_null();
  if (!ran && !refused) return std::nullopt;
  return point_of(exit, error, result);
}

}  // namespace

std::string program_identity(const std::string& version) {
  return version + " " + fingerprint_of_file("/proc/self/exe").value_or("");
}

Json identity(const Plan& plan, const Inputs& inputs, const std::string& program) {
  Json json = {{"format", kFormat},           {"program", program},        {"scenario", plan.scenario},
               {"content", inputs.content()}, {"settings", plan.settings}, {"checks", plan.checks},
               {"parameters", Json::array()}};
  for (const Parameter& parameter : plan.parameters)
    json["parameters"].push_back({{"path", parameter.path}, {"values", parameter.values}});
  return as_kept(json);
}

std::vector<fs::path> own_files(const fs::path& folder) {
  std::vector<fs::path> files;
  try {
    if (!fs::is_directory(folder)) return files;
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (is_result(name) || is_left_over(name)) files.push_back(entry.path());
    }
    if (!fs::is_directory(folder / "points")) return files;
    for (const auto& entry : fs::directory_iterator(folder / "points")) files.push_back(entry.path());
  } catch (const fs::filesystem_error& error) {
    throw InputError(folder.string(), 0, "cannot be used for a sweep: " + error.code().message());
  }
  return files;
}

Folder::Folder(fs::path path, const Json& identity)
    : path_(std::move(path)), identity_(fingerprint(text_of(identity))) {
  try {
    if (fs::exists(path_) && !fs::is_directory(path_))
      throw InputError(path_.string(), 0, "is a file, allowed is a folder for the sweep");
    lock_.emplace(path_);
    open(identity);
  } catch (const fs::filesystem_error& error) {
    throw InputError(path_.string(), 0, "cannot be used for a sweep: " + error.code().message());
  }
}

void Folder::open(const Json& identity) {
  Json before = fs::exists(path_ / "sweep.json") ? read_json(path_ / "sweep.json") : Json();
  const bool ours = before.is_object() && before.value("format", Json()) == kFormat;
  const bool damaged = before.is_discarded();
  if (damaged) before = Json();  // to be compared: what is discarded differs from nothing
  if (!ours && holds_something_else(damaged))
    throw InputError(path_.string(), 0, "holds something else, allowed is a new or empty folder, or one of a sweep");
  if (ours) started_anew_ = difference(before, identity);
  if (damaged) started_anew_ = "nothing that can be known, its sweep.json is damaged";
  if (!started_anew_.empty()) clear();
  tidy();
  // First of all, so that a folder with points always says what they are about.
  if (before != identity) write_file(file("sweep.json"), identity.dump(2) + "\n");
  fs::create_directories(path_ / "points");
}

/// What a sweep writes counts only where a sweep.json, though damaged, says that there was one.
bool Folder::holds_something_else(bool swept) const {
  const auto is_else = [swept](const fs::directory_entry& entry) {
    const std::string name = entry.path().filename().string();
    if (name == Lock::kName || is_left_over(name)) return false;
    return !swept || !(name == "points" || is_result(name));
  };
  return std::any_of(fs::directory_iterator(path_), fs::directory_iterator(), is_else);
}

/// Only what a sweep writes.
void Folder::clear() const {
  fs::remove_all(path_ / "points");
  fs::remove(path_ / "results.csv");
  for (const auto& entry : fs::directory_iterator(path_))
    if (is_picture(entry.path().filename().string())) fs::remove(entry.path());
}

/// Removes what a sweep that was killed has left half done.
void Folder::tidy() const {
  for (const auto& entry : fs::directory_iterator(path_))
    if (is_left_over(entry.path().filename().string())) fs::remove(entry.path());
  if (!fs::exists(path_ / "points")) return;
  for (const auto& entry : fs::directory_iterator(path_ / "points"))
    if (is_remainder(entry.path().filename().string())) fs::remove(entry.path());
}

std::string Folder::point_file(std::size_t point, const std::string& ending) const {
  return (path_ / "points" / fmt::format("{:05}{}", point, ending)).string();
}

/// With the id of this process: a run of an owner before that has not died yet writes into a file of its own.
std::string Folder::result_file(std::size_t point) const { return point_file(point, fmt::format(".{}.run", getpid())); }

std::optional<Point> Folder::finished(std::size_t point, const Plan& plan) const {
  Json kept = read_json(point_file(point, ".json"));
  try {
    const Json sum = kept.at("sum");
    kept.erase("sum");
    const bool whole = sum == fingerprint(text_of(kept));
    if (!whole || kept.at("identity") != identity_ || kept.at("settings") != as_kept(plan.settings_of(point)))
      return std::nullopt;
    return statement(kept.at("exit"), kept.at("error"), kept.at("result"));
  } catch (const nlohmann::json::exception&) {  // no JSON, or not of this form
    return std::nullopt;
  }
}

std::optional<Point> Folder::finish(std::size_t point, const Plan& plan, int exit, const std::string& error) const {
  const Json result = exit == kWrongInput ? Json() : read_json(result_file(point));
  forget(point);
  try {
    if (!statement(exit, error, result)) return std::nullopt;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
  Json kept = as_kept({{"identity", identity_},
                       {"settings", plan.settings_of(point)},
                       {"exit", exit},
                       {"error", error},
                       {"result", result}});
  kept["sum"] = fingerprint(text_of(kept));
  write_file(point_file(point, ".json"), text_of(kept) + "\n");
  return statement(exit, kept["error"], result);
}

void Folder::forget(std::size_t point) const {
  std::error_code ignored;  // the next owner of the folder removes it
  fs::remove(result_file(point), ignored);
}

}  // namespace tb::sweep
