#pragma once
// What a regression runs: scenarios by engines, views, seeds and settings.
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "lab/campaign/folder.hpp"
#include "lab/sweep/plan.hpp"

namespace dsdpv1::tb::regress {

struct Run {
  std::string scenario, engine, view;
  std::string seed;                   ///< empty: nothing in it depends on one
  std::vector<std::string> settings;  ///< PATH=VALUE

  /// "skip pins", "rtl pins seed=3 baud=6M".
  std::string variant() const;
  /// "scenarios/watchdog.yaml skip pins"; each run of a plan has another one.
  std::string name() const { return scenario + " " + variant(); }
  /// The same as the name of a file: letters, digits, "._-".
  std::string file_name() const;
  /// Arguments of this program.
  std::vector<std::string> words() const;
};

/// What the command line asks for.
struct Request {
  std::vector<std::string> scenarios;  ///< files and folders
  std::vector<std::string> engines = {"skip"}, views = {"pins"};
  std::vector<std::string> seeds;                 ///< none: the usual one
  std::vector<sweep::Parameter> parameters = {};  ///< of --set, each with at least one value
  /// Whether the scenario of a run can be carried out by pins only, whatever the engine.
  std::function<bool(const Run& run)> pins_only = [](const Run& /*run*/) { return false; };
};

/// A part of all runs: `index` of `count`, from 1.
struct Shard {
  std::uint64_t index = 1, count = 1;
  /// Depends on the run's name alone, so that a new scenario moves no other run to another shard.
  bool has(const Run& run) const;
};

/// "2/5". Throws InputError.
Shard parse_shard(const std::string& text);
/// "1..4,7" of --seed. Throws InputError.
std::vector<std::string> parse_seeds(const std::string& text);

struct Plan {
  std::vector<Run> runs;
  std::size_t left_out = 0;  ///< combinations that cannot be: RTL, and some scenarios, have pins only
};

/// Throws InputError for a path that is not there, a folder without scenarios, a key that is set twice, seeds without
/// an engine that has something random, more than 100 000 runs, and when nothing is left to be run.
Plan plan_of(const Request& request, const Shard& shard);

campaign::Json json_of(const Run& run);
/// Throws nlohmann::json::exception when it is no run.
Run run_of(const campaign::Json& json);

}  // namespace dsdpv1::tb::regress
