// verify-rtl: RTL of the user's own against the model by everything there is: scenarios, goldens, stimuli, random
// cases.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>

#include "apps/commands/command.hpp"
#include "apps/commands/regression.hpp"
#include "apps/data_folder.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/common.hpp"
#include "apps/options/rtl_options.hpp"
#include "apps/options/scenario_files.hpp"
#include "apps/options/words.hpp"
#include "io/input/input_error.hpp"
#include "lab/traces/golden.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::app {
namespace {

namespace fs = std::filesystem;
using tb::regress::Run;

constexpr const char* kStimulus = ".stimulus";
// Cycles of a run of random cases, a minute or two. It begins with the led ones, so a short run has hardly any others.
constexpr std::uint64_t kPiece = 10'000'000;

class VerifyRtl : public Command {
 public:
  VerifyRtl() : Command("verify-rtl", "Compare your RTL with the model by scenarios, goldens, stimuli, random cases") {
    regression_.command = "dsdpv1-sim verify-rtl";
    regression_.time_limit = 3600;
  }

  void options(CLI::App& app) override {
    app.add_option("FILE", names_,
                   "Scenarios, folders of them, and stimuli (default of each: those of this program, of the chip)");
    add_own_rtl_options(app, own_, true);
    add_coverage_flag(app, description_);
    add_chip_options(app, chip_, false);
    app.add_option("--only", only_, "Only these: scenarios, goldens, stimuli, random, separated by commas")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--cycles", cycles_, "Cycles of random cases, at all of the chip's host ports together")
        ->check(CLI::Range(std::uint64_t{1}, kMostCycles))
        ->capture_default_str();
    app.add_option("--seed", seed_, "Seed of the first random cases")->capture_default_str();
    app.add_option("--set", set_, "chip.KEY=VALUE of stimuli and random cases, once for each: a parameter of the model")
        ->allow_extra_args(false);
    add_regression_options(app, regression_, "rtl-verification");
    app.add_flag("--strict", regression_.strict, "Exit code 3 when a run is only listed, and not run");
    app.footer(
        "\nThe same command resumes an interrupted one, and repeats what a change of the RTL concerns.\n"
        "\nExamples:\n"
        "  dsdpv1-sim verify-rtl --rtl my_chip --top chip --pins pins.yaml --junit rtl.xml\n"
        "  dsdpv1-sim verify-rtl --rtl my_chip --top chip --only random --cycles 1000000000 --seed 7\n"
        "  dsdpv1-sim verify-rtl --rtl my_chip --top chip --chip dsdpv1_rsu --slurm\n"
        "\nExit codes: 0 no difference, 1 a difference or a run that failed, 2 wrong input, 3 none failed, but some "
        "judged nothing, or nothing was run, 130 interrupted.\n");
  }

  int carry_out() override {
    leave_nothing_on_signals();
    regression_.campaign.words = words;
    if (regression_.campaign.out.empty()) regression_.campaign.out = "rtl-verification";
    tb::regress::Description description = description_;
    description.rtl = rtl_of_regression(own_, chip_.kind().name());
    for (const std::string& word : only_)
      check_word("dsdpv1-sim verify-rtl: --only", word, {"scenarios", "goldens", "stimuli", "random"});
    map_ = own_map(own_, chip_.kind());
    check_settings();
    take_names();
    if (wants("goldens") || (wants("scenarios") && scenarios_.empty())) shipped_ = shipped();
    std::vector<Run>& runs = description.plan.runs;
    if (wants("scenarios")) add_scenarios(runs);
    if (wants("goldens")) add_goldens(runs);
    if (wants("stimuli")) add_stimuli(runs);
    if (wants("random")) add_random(runs);
    std::stable_partition(runs.begin(), runs.end(), [](const Run& run) { return run.not_run.empty(); });
    return run_regression(std::move(description), regression_);
  }

 private:
  struct Shipped {
    std::string file;
    std::string not_run;  ///< why not; empty: it is
  };

  bool wants(const char* what) const {
    return only_.empty() || std::find(only_.begin(), only_.end(), what) != only_.end();
  }

  /// Errors that concern all runs alike.
  void check_settings() const {
    if (!set_.empty() && !wants("stimuli") && !wants("random"))
      throw tb::InputError("dsdpv1-sim verify-rtl: --set is for stimuli and random, expected one of them in --only");
    cosim::check_parameters({"dsdpv1-sim verify-rtl", own_.rtl, own_.top, own_.build, {}}, map_, chip_.kind(),
                            *cosim::chip_settings(chip_.kind(), set_));
  }

  /// One that cannot be read passes: its run says why.
  void check_chip(const std::string& scenario) const {
    const tb::ChipKind* kind = &chip_.kind();
    try {
      kind = tb::scenario::load(scenario).kind;
    } catch (const tb::InputError&) {
    }
    if (kind != &chip_.kind())
      throw tb::InputError(scenario, 0,
                           fmt::format("is about a {}, expected a {} as in --chip", kind->name(), chip_.chip));
  }

  /// Sorts the names on the command line.
  void take_names() {
    for (const std::string& name : names_)
      (fs::path(name).extension() == kStimulus ? stimuli_ : scenarios_)
          .push_back(scenario_file("dsdpv1-sim verify-rtl", name));
    scenarios_ = tb::regress::all_files(scenarios_);
    stimuli_ = tb::regress::all_files(stimuli_);
  }

  bool names(const std::string& scenario) const {
    return scenarios_.empty() || std::any_of(
                                     scenarios_.begin(), scenarios_.end(),
                                     [&](const std::string& each) { return fs::equivalent(each, scenario); });
  }

  /// Those of this program and of the chip. One that cannot be read is listed, with the reason.
  std::vector<Shipped> shipped() const {
    std::vector<Shipped> all;
    for (const std::string& file : shipped_scenarios()) {
      try {
        const tb::scenario::Scenario scenario = tb::scenario::load(file);
        if (scenario.kind != &chip_.kind()) continue;
        check_one_chip(scenario, "RTL");
        all.push_back({file, why_not(*scenario.chip)});
      } catch (const tb::InputError& error) {
        all.push_back({file, error.what()});
      }
    }
    return all;
  }

  void add_scenarios(std::vector<Run>& runs) const {
    for (const std::string& file : scenarios_) {
      check_chip(file);
      runs.push_back({file, "cosim", "pins", "", {}});
    }
    if (!scenarios_.empty()) return;
    for (const Shipped& each : shipped_) {
      runs.push_back({each.file, "cosim", "pins", "", {}});
      runs.back().not_run = each.not_run;
    }
  }

  void add_goldens(std::vector<Run>& runs) const {
    const bool tolerant = has_tolerance(map_);
    for (const Shipped& each : shipped_) {
      if (!names(each.file) ||
          !fs::exists(tb::traces::manifest_path(golden_folder(), tb::traces::golden_name(each.file))))
        continue;
      runs.push_back({each.file, "golden", "pins", "", {}});
      runs.back().not_run = tolerant ? "the map has a tolerance, goldens have none" : each.not_run;
    }
  }

  /// Why a scenario whose chip has these settings is not run; empty: it is.
  std::string why_not(const tb::OwnSettings& chip) const {
    const auto keys = cosim::untold(map_, chip_.kind(), chip);
    if (keys.empty()) return "";
    return fmt::format("chip.{} {} not the default here, and the map's chip: does not take {}",
                       fmt::join(keys, ", chip."), keys.size() == 1 ? "is" : "are", keys.size() == 1 ? "it" : "them");
  }

  void add_stimuli(std::vector<Run>& runs) const {
    std::vector<std::string> files = stimuli_;
    if (files.empty())
      for (const auto& entry : fs::directory_iterator(fs::path(data_folder()) / chip_.kind().random()->words().stimuli))
        if (entry.path().extension() == kStimulus) files.push_back(entry.path().string());
    if (stimuli_.empty()) std::sort(files.begin(), files.end());
    for (const std::string& file : files) runs.push_back({file, "replay", "pins", "", set_, {"--chip", chip_.chip}});
  }

  /// In pieces, each with its seed, so that an interruption costs one of them.
  void add_random(std::vector<Run>& runs) const {
    const auto& ports = chip_.kind().random()->words().ports;
    const std::uint64_t each = cycles_ / ports.size();
    for (const cosim::HostPort& port : ports)
      for (std::uint64_t done = 0, seed = seed_; done < each; done += kPiece, ++seed)
        runs.push_back(
            {"random",
             "random",
             "pins",
             std::to_string(seed),
             set_,
             {"--chip", chip_.chip, "--jobs", "1", "--cycles", std::to_string(std::min(kPiece, each - done))},
             port.word});
  }

  std::vector<std::string> names_, only_, set_;
  std::vector<std::string> scenarios_, stimuli_;  ///< in `names_`
  std::vector<Shipped> shipped_;                  ///< as far as they are wanted
  cosim::PinMap map_;
  OwnRtlArguments own_;
  RtlChip chip_;
  tb::regress::Description description_;  ///< coverage; all else is of carry_out
  std::uint64_t cycles_ = 20'000'000, seed_ = 1;
  RegressionArguments regression_;
};

}  // namespace

std::unique_ptr<Command> make_verify_rtl() { return std::make_unique<VerifyRtl>(); }

}  // namespace dsdpv1::app
