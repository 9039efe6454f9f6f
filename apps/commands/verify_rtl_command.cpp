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
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::app {
namespace {

namespace fs = std::filesystem;
using tb::regress::Run;

constexpr std::uint64_t kPiece = 2'500'000;  // cycles of a run of random cases: less than a minute or two

class VerifyRtl : public Command {
 public:
  VerifyRtl() : Command("verify-rtl", "Compare your RTL with the model by scenarios, goldens, stimuli, random cases") {
    regression_.command = "dsdpv1-sim verify-rtl";
    regression_.time_limit = 3600;
  }

  void options(CLI::App& app) override {
    app.add_option("SCENARIO", scenarios_,
                   "Scenarios, and folders of them (default: those of this program, of the chip)");
    add_own_rtl_options(app, own_, true);
    add_chip_options(app, chip_, false);
    app.add_option("--only", only_, "Only these: scenarios, goldens, stimuli, random, separated by commas")
        ->delimiter(',');
    app.add_option("--cycles", cycles_, "Cycles of random cases, at all of the chip's host ports together")
        ->capture_default_str();
    app.add_option("--seed", seed_, "Of the first random cases")->capture_default_str();
    app.add_option("--set", set_, "chip.KEY=VALUE of stimuli and random cases, once for each: a parameter of the model")
        ->allow_extra_args(false);
    add_regression_options(app, regression_, "rtl-verification");
    app.footer(
        "\nThe same command resumes an interrupted one, and repeats what a change of the RTL concerns.\n"
        "\nExamples:\n"
        "  dsdpv1-sim verify-rtl --rtl my_chip --top chip --pins pins.yaml --junit rtl.xml\n"
        "  dsdpv1-sim verify-rtl --rtl my_chip --top chip --only random --cycles 1000000000 --seed 7\n"
        "  dsdpv1-sim verify-rtl --rtl my_chip --top chip --chip dsdpv1_rsu --slurm\n"
        "\nExit codes: 0 no difference, 1 a difference or a run that failed, 2 wrong input, 3 none failed, but some "
        "judged nothing, 130 interrupted.\n");
  }

  int carry_out() override {
    leave_nothing_on_signals();
    regression_.campaign.words = words;
    if (regression_.campaign.out.empty()) regression_.campaign.out = "rtl-verification";
    tb::regress::Description description;
    description.rtl = rtl_of_regression(own_, chip_.kind().name());
    for (const std::string& word : only_)
      check_word("dsdpv1-sim verify-rtl: --only", word, {"scenarios", "goldens", "stimuli", "random"});
    std::vector<Run>& runs = description.plan.runs;
    const std::vector<std::string> of_program = shipped();
    if (wants("scenarios")) add_scenarios(of_program, runs);
    if (wants("goldens") && !has_tolerance(own_map(own_, chip_.kind()))) add_goldens(of_program, runs);
    if (wants("stimuli")) add_stimuli(runs);
    if (wants("random")) add_random(runs);
    return run_regression(std::move(description), regression_);
  }

 private:
  bool wants(const char* what) const {
    return only_.empty() || std::find(only_.begin(), only_.end(), what) != only_.end();
  }

  /// A scenario that cannot be read counts: its run says why.
  bool is_of_the_chip(const std::string& scenario) const {
    try {
      return tb::scenario::load(scenario).kind == &chip_.kind();
    } catch (const tb::InputError&) {
      return !scenarios_.empty();
    }
  }

  std::vector<std::string> shipped() const {
    std::vector<std::string> files = shipped_scenarios();
    files.erase(
        std::remove_if(files.begin(), files.end(), [this](const std::string& file) { return !is_of_the_chip(file); }),
        files.end());
    return files;
  }

  void add_scenarios(const std::vector<std::string>& of_program, std::vector<Run>& runs) const {
    const std::vector<std::string> files = scenarios_.empty() ? of_program : tb::regress::all_files(scenarios_);
    for (const std::string& file : files) runs.push_back({file, "cosim", "pins", "", {}});
  }

  static void add_goldens(const std::vector<std::string>& of_program, std::vector<Run>& runs) {
    for (const std::string& file : of_program)
      if (fs::exists(fs::path(data_folder()) / "traces" / (fs::path(file).stem().string() + ".json")))
        runs.push_back({file, "golden", "pins", "", {}});
  }

  void add_stimuli(std::vector<Run>& runs) const {
    const fs::path folder = fs::path(data_folder()) / chip_.kind().random()->words().stimuli;
    std::vector<std::string> files;
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".stimulus") files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    for (const std::string& file : files) runs.push_back({file, "replay", "pins", "", set_, {"--chip", chip_.chip}});
  }

  /// In pieces, each with a seed of its own, so that an interruption costs one of them.
  void add_random(std::vector<Run>& runs) const {
    const auto& ports = chip_.kind().random()->words().ports;
    const std::uint64_t each = cycles_ / ports.size();
    for (const cosim::HostPort& port : ports)
      for (std::uint64_t done = 0, seed = seed_; done < each; done += kPiece, ++seed)
        runs.push_back({"random",
                        "random",
                        "pins",
                        std::to_string(seed),
                        set_,
                        {"--chip", chip_.chip, "--mode", port.word, "--jobs", "1", "--cycles",
                         std::to_string(std::min(kPiece, each - done))}});
  }

  std::vector<std::string> scenarios_, only_, set_;
  OwnRtlArguments own_;
  RtlChip chip_;
  std::uint64_t cycles_ = 20'000'000, seed_ = 1;
  RegressionArguments regression_;
};

}  // namespace

std::unique_ptr<Command> make_verify_rtl() { return std::make_unique<VerifyRtl>(); }

}  // namespace dsdpv1::app
