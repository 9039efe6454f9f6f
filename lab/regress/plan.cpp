#include "lab/regress/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"
#include "io/input/units.hpp"
#include "lab/campaign/fingerprint.hpp"

namespace dsdpv1::tb::regress {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostRuns = 100'000;

bool is_rtl(const std::string& engine) { return engine == "rtl" || engine == "lockstep"; }
bool is_about_pins(const std::string& engine) { return is_rtl(engine) || engine == "cosim"; }

bool is_scenario(const fs::directory_entry& entry) {
  const fs::path ending = entry.path().extension();
  return (ending == ".yaml" || ending == ".yml") && !entry.is_directory();
}

std::vector<std::string> scenarios_in(const std::string& folder) {
  std::vector<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (is_scenario(entry)) found.push_back(entry.path().lexically_normal().string());
  if (found.empty()) throw InputError(folder, 0, "holds no scenario, expected a folder with .yaml or .yml files");
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::string> files_of(const std::string& path) {
  try {
    if (fs::is_directory(path)) return scenarios_in(path);
    if (fs::exists(path)) return {fs::path(path).lexically_normal().string()};
  } catch (const fs::filesystem_error& error) {
    throw InputError(path, 0,
                     "cannot be read (" + error.code().message() + "), expected scenarios and folders of them");
  }
  throw InputError(path, 0, "no such file or folder, expected scenarios and folders of them");
}

/// Every combination of the parameters' values; one without settings when there are none.
std::vector<std::vector<std::string>> combinations(const std::vector<sweep::Parameter>& parameters) {
  const sweep::Plan product{"", {}, "", parameters};
  std::set<std::string> paths;
  for (const sweep::Parameter& each : parameters)
    if (!paths.insert(each.path).second) throw InputError("--set " + each.path, 0, "is set twice, expected once");
  std::vector<std::vector<std::string>> all;
  if (product.points() > kMostRuns)
    throw InputError(fmt::format("dsdpv1-sim regress: more than {} runs, expected fewer values", kMostRuns));
  for (std::size_t i = 0; i < product.points(); ++i) all.push_back(product.settings_of(i));
  return all;
}

/// Only RTL has random values: those of registers that are not reset.
std::vector<std::string> seeds_of(const Request& request, const std::string& engine) {
  return request.seeds.empty() || !is_rtl(engine) ? std::vector<std::string>{""} : request.seeds;
}

void check_seeds(const Request& request) {
  if (request.seeds.empty() || std::any_of(request.engines.begin(), request.engines.end(), is_rtl)) return;
  throw InputError("dsdpv1-sim regress: --seed changes nothing with --engine " + join(request.engines) +
                   ": it is for what RTL begins with where nothing is reset, it needs rtl, lockstep");
}

void add_runs(const Request& request, const Shard& shard, const Run& run,
              const std::vector<std::vector<std::string>>& settings, Plan& plan) {
  for (const std::string& seed : seeds_of(request, run.engine)) {
    for (const std::vector<std::string>& each : settings) {
      const Run next{run.scenario, run.engine, run.view, seed, each};
      if (!shard.has(next)) continue;
      if (run.view == "tlm" && (is_about_pins(run.engine) || request.pins_only(next)))
        ++plan.left_out;
      else
        plan.runs.push_back(next);
      if (plan.runs.size() > kMostRuns)
        throw InputError(fmt::format("dsdpv1-sim regress: more than {} runs, expected fewer of them", kMostRuns));
    }
  }
}

/// What names it without options.
std::vector<std::string> command_of(const Run& run) {
  if (run.engine == "cosim") return {"cosim", run.scenario};
  if (run.engine == "golden") return {"traces", "check", run.scenario};
  if (run.engine == "replay") return {"rtl-random", "--replay", run.scenario};
  if (run.engine == "random") return {"rtl-random"};
  return {"run", run.scenario, "--engine", run.engine, "--view", run.view};
}

void append(std::vector<std::string>& words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
}

}  // namespace

std::vector<std::string> OwnRtl::words() const {
  std::vector<std::string> words = {"--rtl", folder, "--top", top, "--build", build};
  if (!pins.empty()) append(words, {"--pins", pins});
  return words;
}

std::vector<std::string> all_files(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  std::set<std::string> seen;
  for (const std::string& path : paths)
    for (const std::string& file : files_of(path))
      if (seen.insert(file).second) files.push_back(file);
  return files;
}

std::string Run::variant() const {
  std::string text = engine + " " + view + (mode.empty() ? "" : " " + mode);
  for (const std::string& option : options) text += " " + option;
  if (!seed.empty()) text += " seed=" + seed;
  for (const std::string& setting : settings) text += " " + setting;
  return text;
}

std::string Run::file_name() const {
  constexpr std::size_t kMostOfStem = 60;
  std::string stem = fs::path(scenario).stem().string().substr(0, kMostOfStem);
  const auto is_plain = [](unsigned char c) { return c < 0x80 && (std::isalnum(c) != 0 || c == '_' || c == '-'); };
  for (char& c : stem)
    if (!is_plain(static_cast<unsigned char>(c))) c = '_';
  return stem + "." + engine + "." + view + "." + campaign::fingerprint(name());
}

std::vector<std::string> Run::words() const {
  std::vector<std::string> words = command_of(*this);
  append(words, options);
  if (!mode.empty()) append(words, {"--mode", mode});
  if (!seed.empty()) append(words, {"--seed", seed});
  for (const std::string& setting : settings) append(words, {"--set", setting});
  return words;
}

bool Shard::has(const Run& run) const {
  constexpr int kHex = 16;
  return std::stoull(campaign::fingerprint(run.name()), nullptr, kHex) % count == index - 1;
}

Shard parse_shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  const auto index = parse_integer(text.substr(0, slash));
  const auto count = parse_integer(slash == std::string::npos ? "" : text.substr(slash + 1));
  if (!index || !count || *index < 1 || *count < *index)
    throw InputError("dsdpv1-sim regress: --shard is " + text + ", expected something like 2/5: the second of five");
  return {static_cast<std::uint64_t>(*index), static_cast<std::uint64_t>(*count)};
}

std::vector<std::string> parse_seeds(const std::string& text) {
  constexpr std::int64_t kMost = 0xFFFF'FFFF;
  const std::string origin = "--seed " + text;
  std::vector<std::string> seeds = sweep::values_of(keys::Kind::kInteger, text, origin);
  for (const std::string& seed : seeds) {
    const auto number = parse_integer(seed);
    if (!number || *number < 0 || *number > kMost)
      throw InputError(origin, 0, "seed is \"" + seed + "\", expected a whole number from 0 to 4294967295");
  }
  return seeds;
}

Plan plan_of(const Request& request, const Shard& shard) {
  check_seeds(request);
  const std::vector<std::vector<std::string>> settings = combinations(request.parameters);
  Plan plan;
  for (const std::string& scenario : all_files(request.scenarios))
    for (const std::string& engine : request.engines)
      for (const std::string& view : request.views)
        add_runs(request, shard, {scenario, engine, view, "", {}}, settings, plan);
  if (plan.runs.empty() && plan.left_out != 0 && shard.count == 1)
    throw InputError(
        "dsdpv1-sim regress: nothing is left to be run: --view tlm is neither for RTL nor for ARM boards at serial "
        "ports, expected --view pins");
  return plan;
}

campaign::Json json_of(const Run& run) {
  return {{"scenario", run.scenario}, {"engine", run.engine},   {"view", run.view}, {"seed", run.seed},
          {"settings", run.settings}, {"options", run.options}, {"mode", run.mode}, {"not_run", run.not_run}};
}

Run run_of(const campaign::Json& json) {
  return {json.at("scenario"),
          json.at("engine"),
          json.at("view"),
          json.at("seed"),
          json.at("settings").get<std::vector<std::string>>(),
          json.value("options", std::vector<std::string>()),
          json.value("mode", ""),
          json.value("not_run", "")};
}

}  // namespace dsdpv1::tb::regress
