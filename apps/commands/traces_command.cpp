// traces: golden traces checked, made again, listed, and turned into waves.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>

#include "apps/commands/command.hpp"
#include "apps/commands/scenario_run.hpp"
#include "apps/data_folder.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/outputs.hpp"
#include "apps/options/rtl_options.hpp"
#include "apps/options/scenario_files.hpp"
#include "bus/printable.hpp"
#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"
#include "io/waves/wave_writer.hpp"
#include "lab/traces/golden.hpp"
#include "lab/traces/golden_check.hpp"
#include "lab/traces/trace_wave.hpp"
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

constexpr const char* kTracesFooter =
    "\nExamples:\n  dsdpv1-sim traces check\n  dsdpv1-sim traces check power_on_12m --engine rtl\n"
    "  dsdpv1-sim traces check power_on_12m --rtl my_chip --top chip --pins pins.yaml\n"
    "  dsdpv1-sim traces regenerate scenarios/power_on_12m.yaml\n  dsdpv1-sim traces wave power_on_12m golden.fst\n"
    "docs/traces.md says what they are.\n"
    "\nExit codes: 0 no difference, 1 a difference, 2 wrong input, 130 interrupted.\n";

struct TracesArguments {
  std::vector<std::string> scenarios;  ///< names or paths; empty: all
  std::string folder;                  ///< of the goldens; empty: traces of the source tree
  std::string engine = "skip";
  unsigned fault = 0;          ///< of rtl_ref/dsdpv1/faults.txt, 0: none
  OwnRtlArguments own;         ///< in place of the reference RTL
  std::string golden, output;  ///< of wave: its name and the file
  std::optional<bool> progress;
};

std::string folder_of(const TracesArguments& given) { return given.folder.empty() ? golden_folder() : given.folder; }

/// Exit codes of several scenarios: wrong input before a difference, and that before one that judged nothing.
int worse(int a, int b) {
  static constexpr std::array<int, 4> kFromBest = {kPassed, kNothingJudged, kFailed, kWrongInput};
  return *std::max(std::find(kFromBest.begin(), kFromBest.end(), a), std::find(kFromBest.begin(), kFromBest.end(), b));
}

/// Checks each scenario separately: reports the faults of one and continues with the others.
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

/// Goldens without a scenario; only if all are checked.
int report_orphans(const std::string& folder) {
  int status = kPassed;
  for (const std::string& name : tb::traces::golden_names(folder)) {
    const fs::path file = fs::path(scenario_folder()) / (name + ".yaml");
    if (fs::exists(file)) continue;
    std::cerr << fmt::format("{}: there is no scenario {}, expected goldens of scenarios: remove it and {}\n",
                             tb::traces::manifest_path(folder, name), file.string(),
                             tb::traces::trace_path(folder, name));
    status = kWrongInput;
  }
  return status;
}

/// The scenarios given, or all and then the goldens without one.
int for_scenarios(const TracesArguments& given, const std::function<int(const std::string& file)>& work) {
  if (given.scenarios.empty()) {
    const int status = for_each(shipped_scenarios(), work);
    return status == kInterrupted ? status : worse(status, report_orphans(folder_of(given)));
  }
  std::vector<std::string> files;
  std::transform(given.scenarios.begin(), given.scenarios.end(), std::back_inserter(files),
                 [](const std::string& word) { return scenario_file("dsdpv1-sim traces", word); });
  return for_each(files, work);
}

/// Makes the user's own RTL as the scenario wants it; empty: there is none. Its chip is that of the first scenario.
OwnRtl own_rtl_for(const std::string& file, const TracesArguments& given, const tb::ChipKind*& chip) {
  if (given.own.rtl.empty()) return {};
  const tb::scenario::Scenario scenario = tb::scenario::load(file);
  check_one_chip(scenario, "RTL");
  if (chip == nullptr) chip = scenario.kind;
  if (chip != scenario.kind)
    throw tb::InputError(file, 0,
                         fmt::format("is about a {}, expected a {} as before", scenario.kind->name(), chip->name()));
  if (has_tolerance(own_map(given.own, *scenario.kind)))
    throw tb::InputError(given.own.pins, 0, "has a tolerance, goldens have none, expected cosim and scenarios");
  return build_own_rtl(given.own, "dsdpv1-sim traces", *scenario.kind, *scenario.chip, false);
}

/// Scenarios of kinds without RTL are left out of all scenarios, and refused if they are named.
bool is_left_out(const TracesArguments& given, const std::string& file) {
  const bool needs_rtl = given.engine == "rtl" || given.engine == "lockstep";
  return needs_rtl && given.scenarios.empty() && !has_rtl(tb::scenario::load(file));
}

int check(const TracesArguments& given) {
  if (!given.own.rtl.empty() && given.scenarios.empty())
    throw tb::InputError("dsdpv1-sim traces check: --rtl needs the scenarios of its chip, expected SCENARIO...");
  check_outputs("dsdpv1-sim traces check", {{"--pins", given.own.pins}}, {{"--coverage", given.own.coverage}});
  CoverageFile coverage(given.own);
  const tb::ChipKind* chip = nullptr;
  const int status = for_scenarios(given, [&](const std::string& file) {
    if (is_left_out(given, file)) return kPassed;
    RunArguments one;
    one.scenario = file;
    one.engine = given.own.rtl.empty() ? given.engine : "rtl";
    one.fault = given.fault;
    one.golden = folder_of(given);
    one.difference = "";
    one.progress = given.progress;
    one.quiet = true;
    const OwnRtl own = own_rtl_for(file, given, chip);
    const cosim::MakeRtl make = [&own](auto&&...) { return own.make(std::nullopt); };
    const int of_run = run(one, own.make ? make : cosim::MakeRtl());
    coverage.add(own);
    return of_run;
  });
  coverage.write();
  return status;
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

/// A run that writes its trace, which is compared with the golden before.
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
    tb::Progress progress(scenario_.end, shows_progress(progress_bar));
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

int regenerate(const TracesArguments& given) {
  const std::string folder = folder_of(given);
  tb::traces::golden_names(folder);  // refuses a path that is not a folder before anything is run
  catch_signals();
  return for_scenarios(given, [&](const std::string& file) {
    const tb::scenario::Scenario scenario = tb::scenario::load(file);
    Regeneration regeneration(scenario, folder);
    const tb::RunResult result = regeneration.run(given.progress);
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

int list(const TracesArguments& given) {
  const std::string folder = folder_of(given);
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

int wave(const TracesArguments& given) {
  const std::string folder = folder_of(given), name = golden_name(given.golden);
  tb::check_wave_name(given.output);
  check_outputs(
      "dsdpv1-sim traces wave",
      {{"the manifest", tb::traces::manifest_path(folder, name)}, {"the golden", tb::traces::trace_path(folder, name)}},
      {{"the wave", given.output}});
  tb::traces::write_wave(*tb::traces::read_golden(folder, name).trace, given.output);
  return kPassed;
}

class Traces : public Command {
 public:
  Traces() : Command("traces", "Check, regenerate or export golden traces of all pins") {}

  void options(CLI::App& app) override {
    app.require_subcommand(0, 1);  // carry_out says in its own words what is missing
    CLI::App* check_them = add_action(app, "check", "Run scenarios and compare every change of every pin", check);
    add_scenarios(*check_them);
    CLI::Option* engine = check_them->add_option("--engine", given_.engine, "As for run: step, skip, rtl, lockstep")
                              ->capture_default_str();
    CLI::Option* fault = add_fault_option(*check_them, given_.fault);
    add_own_rtl_options(*check_them, given_.own, false);
    add_coverage_option(*check_them, given_.own);
    check_them->get_option("--rtl")->excludes(engine)->excludes(fault);
    add_scenarios(*add_action(app, "regenerate",
                              "Regenerate goldens, write those that differ and summarise the changes", regenerate));
    add_action(app, "list", "List the goldens", list);
    CLI::App* as_wave = add_action(app, "wave", "Write a golden as a wave", wave);
    as_wave->add_option("SCENARIO", given_.golden, "Its name, or the scenario's path")->required();
    as_wave->add_option("FILE", given_.output, "FILE.vcd or FILE.fst")->required();
    app.footer(kTracesFooter);
  }

  int carry_out() override {
    leave_nothing_on_signals();
    if (action_ != nullptr) return action_(given_);
    throw tb::InputError("dsdpv1-sim traces: an action is missing, expected check, regenerate, list, wave");
  }

 private:
  using Action = int (*)(const TracesArguments& given);

  CLI::App* add_action(CLI::App& traces, const char* name, const char* line, Action action) {
    CLI::App* app = traces.add_subcommand(name, line);
    app->callback([this, action] { action_ = action; });
    app->add_option(
        "--folder", given_.folder,
        "Folder of the golden traces (default: traces of this source tree, whose scenarios have the names)");
    app->footer(kTracesFooter);
    return app;
  }

  void add_scenarios(CLI::App& app) {
    app.add_option("SCENARIO", given_.scenarios, "Scenarios by name or path (default: all of scenarios/)");
    app.add_flag_callback(
        "--no-progress", [this] { given_.progress = false; }, "Show no progress bar");
  }

  TracesArguments given_;
  Action action_ = nullptr;
};

}  // namespace

std::unique_ptr<Command> make_traces() { return std::make_unique<Traces>(); }

}  // namespace dsdpv1::app
