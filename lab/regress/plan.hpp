#pragma once
// The runs of a regression: scenarios by engines, views, seeds and settings.
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "lab/campaign/folder.hpp"
#include "lab/sweep/plan.hpp"

namespace dsdpv1::tb::regress {

/// RTL of the user's own, which runs with these engines are about.
struct OwnRtl {
  std::string folder, top, pins, build;                 ///< as --rtl, --top, --pins, --build; empty: there is none
  std::string chip;                                     ///< its kind
  std::vector<std::string> files = {};                  ///< a run depends on them
  campaign::Json tolerance = campaign::Json::object();  ///< of pins, in cycles of 48 MHz
  std::string fingerprint = {}, verilator = {};         ///< of its build; which built it

  /// The options.
  std::vector<std::string> words() const;
};

struct Run {
  std::string scenario;  ///< or the stimulus of "replay"
  std::string engine;    ///< of run; or, of OwnRtl: "cosim", "golden", "replay", "random"
  std::string view;
  std::string seed;                       ///< empty: the run does not depend on one
  std::vector<std::string> settings;      ///< PATH=VALUE
  std::vector<std::string> options = {};  ///< more words of its command
  std::string mode = {};                  ///< host port of random cases; empty: the scenario, or stimulus, sets it
  std::string not_run = {};               ///< why it is only listed; empty: it is run

  bool has_own_rtl() const { return engine == "cosim" || engine == "golden" || is_stimulus(); }
  /// It has no scenario.
  bool is_stimulus() const { return engine == "replay" || engine == "random"; }

  /// "skip pins", "rtl pins seed=3 baud=6M".
  std::string variant() const;
  /// "scenarios/watchdog.yaml skip pins"; unique in a plan.
  std::string name() const { return scenario + " " + variant(); }
  /// The same as the name of a file: letters, digits, "._-".
  std::string file_name() const;
  /// Arguments of this program.
  std::vector<std::string> words() const;
};

/// The choices of the command line.
struct Request {
  std::vector<std::string> scenarios;  ///< files and folders
  std::vector<std::string> engines = {"skip"}, views = {"pins"};
  std::vector<std::string> seeds;                 ///< none: the default
  std::vector<sweep::Parameter> parameters = {};  ///< of --set, each with at least one value
  /// True when the scenario of a run needs the view pins with every engine.
  std::function<bool(const Run& run)> pins_only = [](const Run& /*run*/) { return false; };
};

/// A part of all runs: `index` of `count`, from 1.
struct Shard {
  std::uint64_t index = 1, count = 1;
  /// Depends only on the run's name, so that a new scenario moves no other run to another shard.
  bool has(const Run& run) const;
};

/// "2/5". Throws InputError.
Shard parse_shard(const std::string& text);
/// "1..4,7" of --seed. Throws InputError.
std::vector<std::string> parse_seeds(const std::string& text);

struct Plan {
  std::vector<Run> runs;
  std::size_t left_out = 0;  ///< impossible combinations: RTL, and some scenarios, have pins only
};

/// The scenarios that files and folders hold, each once, in the order given. Throws InputError.
std::vector<std::string> all_files(const std::vector<std::string>& paths);

/// Throws InputError for a missing path, a folder without scenarios, a key that is set twice, seeds without an engine
/// that uses them, more than 100 000 runs, and when no run remains.
Plan plan_of(const Request& request, const Shard& shard);

campaign::Json json_of(const Run& run);
/// Throws nlohmann::json::exception for any other JSON.
Run run_of(const campaign::Json& json);

}  // namespace dsdpv1::tb::regress
