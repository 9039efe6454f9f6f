#include "apps/commands/traces_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>

#include "apps/command_line.hpp"
#include "apps/data_folder.hpp"
#include "apps/hand_over.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/outputs.hpp"
#include "bus/printable.hpp"
#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"
#include "io/waves/wave_writer.hpp"
#include "lab/traces/golden.hpp"
#include "lab/traces/golden_check.hpp"
#include "lab/traces/trace_wave.hpp"
#include "tb/bench/bench.hpp"
#include "tb/bench/verdict.hpp"
#include "tb/report/progress.hpp"
#include "tb/report/text_table.hpp"

namespace dsdpv1::app {
namespace {

namespace fs = std::filesystem;
using tb::traces::golden_name;

constexpr const char* kTool = "dsdpv1-sim " DSDPV1_VERSION;
const std::vector<std::string> kRulings = {"docs/chip.md", "docs/microarchitecture.md", "docs/chip_rsu.md",
                                           "docs/microarchitecture_rsu.md"};

std::string folder_of(const TracesArguments& arguments) {
  if (!arguments.folder.empty()) return arguments.folder;
  return fs::path(data_folder()) / "traces";
}

fs::path scenario_folder() { return fs::path(data_folder()) / "scenarios"; }

std::vector<std::string> own_scenarios() {
  std::error_code error;
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(scenario_folder(), error))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  if (error)
    throw tb::InputError(scenario_folder(), 0, "is no folder of scenarios, allowed are scenarios by their paths");
  std::sort(files.begin(), files.end());
  return files;
}

/// A path as it is; a name without folder and ending is that of a scenario of this source tree.
std::string scenario_file(const std::string& word) {
  const bool path = word.find('/') != std::string::npos || fs::path(word).has_extension();
  if (path) return word;
  std::string file = scenario_folder() / (word + ".yaml");
  if (fs::exists(file)) return file;
  std::vector<std::string> names;
  for (const std::string& each : own_scenarios()) names.push_back(golden_name(each));
  throw tb::InputError(fmt::format("dsdpv1-sim traces: there is no scenario {}{}, allowed are {}", word,
                                   tb::did_you_mean(word, names), tb::join(names)));
}

/// Exit codes of several scenarios: wrong input before a difference, and that before one that judged nothing.
int worse(int a, int b) {
  static constexpr std::array<int, 4> kFromBest = {kPassed, kNothingJudged, kFailed, kWrongInput};
  return *std::max(std::find(kFromBest.begin(), kFromBest.end(), a), std::find(kFromBest.begin(), kFromBest.end(), b));
}

/// Each scenario by itself: what is wrong with one is said, and the others are looked at.
int for_each(const std::vector<std::string>& files, const std::function<int(const std::string& file)>& work) {
  int status = kPassed;
  for (const std::string& file : files) {
    if (interrupted()) return kInterrupted;
    try {
      status = worse(status, work(file));
    } catch (const tb::InputError& error) {
      std::cerr << bus::printable(error.what()) << '\n';
      status = worse(status, kWrongInput);
    }
  }
  return status;
}

/// Goldens that no scenario belongs to; only where all are looked at.
int report_orphans(const std::string& folder) {
  int status = kPassed;
  for (const std::string& name : tb::traces::golden_names(folder)) {
    const fs::path file = scenario_folder() / (name + ".yaml");
    if (fs::exists(file)) continue;
    std::cerr << fmt::format("{}: there is no scenario {}, allowed are goldens of scenarios: remove it and {}\n",
                             tb::traces::manifest_path(folder, name), file.string(),
                             tb::traces::trace_path(folder, name));
    status = kWrongInput;
  }
  return status;
}

/// Where one of them is another program's, that one looks at all of them.
void hand_over_any(const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    try {
      hand_over(tb::scenario::load(file));
    } catch (const tb::InputError&) {  // is said when it is its turn
    }
  }
}

/// The scenarios given, or all and then the goldens without one.
int for_scenarios(const TracesArguments& arguments, const std::function<int(const std::string& file)>& work) {
  if (arguments.scenarios.empty()) {
    hand_over_any(own_scenarios());
    const int status = for_each(own_scenarios(), work);
    return status == kInterrupted ? status : worse(status, report_orphans(folder_of(arguments)));
  }
  std::vector<std::string> files;
  std::transform(arguments.scenarios.begin(), arguments.scenarios.end(), std::back_inserter(files), scenario_file);
  hand_over_any(files);
  return for_each(files, work);
}

int check(const TracesArguments& arguments) {
  return for_scenarios(
      arguments,
      [&arguments](const std::string& file) {
        RunArguments one;
        one.scenario = file;
        one.engine = arguments.engine;
        one.fault = arguments.fault;
        one.golden = folder_of(arguments);
        one.difference = "";
        one.progress = arguments.progress;
        one.quiet = true;
        return run(one);
      });
}

// --- regenerate ------------------------------------------------------------------------------------------------------

/// The golden that is there, as far as a run of the scenario can be compared with it.
std::unique_ptr<tb::traces::Trace> present_golden(const std::string& folder, const tb::scenario::Scenario& scenario) {
  try {
    std::unique_ptr<tb::traces::Trace> trace = tb::traces::read_golden(folder, golden_name(scenario.file)).trace;
    if (trace->signals() == tb::traces::signals_of(scenario)) return trace;
  } catch (const tb::InputError&) {
    // It is replaced, whatever is wrong with it.
  }
  return nullptr;
}

/// A run that writes its trace, held against the golden before.
class Regeneration {
 public:
  Regeneration(const tb::scenario::Scenario& scenario, const std::string& folder)
      : scenario_(scenario), before_(present_golden(folder, scenario)), writer_(tb::traces::signals_of(scenario)) {
    if (before_) check_.emplace(*before_, scenario);
  }

  tb::RunResult run(std::optional<bool> progress_bar) {
    std::unique_ptr<tb::Execution> execution = tb::make_pin_execution();
    tb::traces::Tap tap(scenario_, execution->segment());
    tap.add(writer_);
    tb::RunOptions options;
    options.observers = {&tap};
    if (check_) {
      tap.add(*check_);
      options.observers.push_back(&*check_);
    }
    tb::Bench bench(scenario_, options, std::move(execution));
    tb::Progress progress(scenario_.end, progress_bar.value_or(isatty(STDERR_FILENO) != 0));
    tb::RunResult result = bench.run([&](tb::Tick now) {
      progress.show(now);
      if (check_) check_->reached(now);
      return !interrupted();
    });
    progress.clear();
    if (check_ && !result.interrupted) check_->finish();
    return result;
  }

  tb::traces::NewGolden golden() const {
    return tb::traces::make_golden(scenario_, writer_.content(scenario_.end), kTool,
                                   tb::traces::rulings_of(data_folder(), kRulings));
  }

  std::string words(const tb::traces::NewGolden& now, const tb::traces::Written& written) const {
    const std::string name = golden_name(scenario_.file);
    const auto changes = now.manifest["changes"].get<std::uint64_t>();
    if (!written.trace)
      return fmt::format("{}: the same, {} changes{}\n", name, changes, written.manifest ? ", manifest written" : "");
    if (!before_) return fmt::format("{}: new, {} changes\n", name, changes);
    return fmt::format("{}: other, {} changes before, {} now\n{}", name, before_->changes(), changes,
                       check_->difference() ? check_->words() : "");
  }

 private:
  const tb::scenario::Scenario& scenario_;
  std::unique_ptr<tb::traces::Trace> before_;
  tb::traces::TraceWriter writer_;
  std::optional<tb::traces::GoldenCheck> check_;
};

int regenerate(const TracesArguments& arguments) {
  const std::string folder = folder_of(arguments);
  tb::traces::golden_names(folder);  // refuses what is no folder before anything is run
  catch_signals();
  return for_scenarios(arguments, [&](const std::string& file) {
    const tb::scenario::Scenario scenario = tb::scenario::load(file);
    Regeneration regeneration(scenario, folder);
    const tb::RunResult result = regeneration.run(arguments.progress);
    if (result.interrupted) return kInterrupted;
    if (const tb::Verdict verdict = tb::verdict(result); verdict != tb::Verdict::kPassed) {
      std::cout << golden_name(file) << ": does not pass, its golden stays as it is\n" << std::flush;
      return tb::exit_code(verdict);
    }
    const tb::traces::NewGolden golden = regeneration.golden();
    const tb::traces::Written written = tb::traces::write_golden(folder, golden_name(file), golden);
    std::cout << regeneration.words(golden, written) << std::flush;
    return kPassed;
  });
}

// --- list, wave ------------------------------------------------------------------------------------------------------

int list(const TracesArguments& arguments) {
  const std::string folder = folder_of(arguments);
  const tb::traces::Json rulings = tb::traces::rulings_of(data_folder(), kRulings);
  tb::TextTable table({"golden", "slaves", "cycles", "changes", "KB", "rulings"});
  for (const std::string& name : tb::traces::golden_names(folder)) {
    const tb::traces::Json manifest = tb::traces::read_manifest(folder, name);
    const auto number = [&manifest](const char* key) { return manifest.contains(key) ? manifest[key].dump() : "?"; };
    std::error_code error;
    const auto bytes = fs::file_size(tb::traces::trace_path(folder, name), error);
    table.add({name, fmt::format("{}", manifest.value("slaves", tb::traces::Json::object()).size()), number("cycles"),
               number("changes"), error ? "missing" : fmt::format("{:.1f}", static_cast<double>(bytes) / 1024),
               manifest.value("rulings", tb::traces::Json()) == rulings ? "as they are" : "of before"});
  }
  std::cout << table.text();
  return kPassed;
}

int wave(const TracesArguments& arguments) {
  const std::string folder = folder_of(arguments), name = golden_name(arguments.golden);
  tb::check_wave_name(arguments.output);
  check_outputs(
      "dsdpv1-sim traces wave",
      {{"the manifest", tb::traces::manifest_path(folder, name)}, {"the golden", tb::traces::trace_path(folder, name)}},
      {{"the wave", arguments.output}});
  tb::traces::write_wave(*tb::traces::read_golden(folder, name).trace, arguments.output);
  return kPassed;
}

}  // namespace

int traces(const TracesArguments& arguments) {
  leave_nothing_on_signals();
  if (arguments.action == "check") return check(arguments);
  if (arguments.action == "regenerate") return regenerate(arguments);
  if (arguments.action == "list") return list(arguments);
  if (arguments.action == "wave") return wave(arguments);
  throw tb::InputError("dsdpv1-sim traces: an action is missing, allowed are check, regenerate, list, wave");
}

}  // namespace dsdpv1::app
