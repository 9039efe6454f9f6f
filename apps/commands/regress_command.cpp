// regress: many runs in child processes or on a cluster, then the tables and the page.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "apps/commands/command.hpp"
#include "apps/commands/regression.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/common.hpp"
#include "apps/options/rtl_options.hpp"
#include "apps/options/scenario_files.hpp"
#include "apps/options/words.hpp"
#include "io/input/input_error.hpp"
#include "tb/chip/chip_kind.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::app {
namespace {

using tb::regress::Description;
using tb::regress::Run;

/// Words of a list, each once.
void check_words(const std::string& option, const std::vector<std::string>& given,
                 const std::vector<std::string>& allowed) {
  std::set<std::string> seen;
  for (const std::string& word : given) {
    check_word("dsdpv1-sim regress: " + option, word, allowed);
    if (!seen.insert(word).second)
      throw tb::InputError(fmt::format("dsdpv1-sim regress: {} has {} twice, expected once", option, word));
  }
}

bool pins_only(const Run& run) {
  try {
    const auto scenario = tb::scenario::load(run.scenario, tb::scenario::parse_settings(run.settings));
    return tb::scenario::needs_pins(scenario);
  } catch (const tb::InputError&) {  // the run says what is wrong
    return false;
  }
}

class Regress : public Command {
 public:
  Regress()
      : Command("regress", "Run scenarios with all combinations of engines, views and settings, and judge each run") {}

  void options(CLI::App& app) override {
    const std::vector<CLI::Option*> of_plan = add_plan_options(app);
    CLI::Option* failed = app.add_flag("--failed", failed_, "Repeat the runs in --out that did not pass");
    for (CLI::Option* other : of_plan) failed->excludes(other);
    add_regression_options(app, regression_, "regression");
    app.footer(
        "\nExamples:\n"
        "  dsdpv1-sim regress\n"
        "  dsdpv1-sim regress scenarios my.yaml --engine step,skip,lockstep --view pins,tlm --junit report.xml\n"
        "  dsdpv1-sim regress my.yaml --set user_cpu.fsmc.datast=2..5 --set baud=12M,6M --wave fst --report\n"
        "  dsdpv1-sim regress --engine rtl --seed 1..8 --shard 2/5 --out part_2\n"
        "  dsdpv1-sim regress --engine cosim --rtl my_chip --top chip --pins pins.yaml\n"
        "  dsdpv1-sim regress --failed\n"
        "The same command resumes an interrupted regression. docs/regress.md explains the results.\n"
        "\nExit codes: 0 all runs passed, 1 some did not, 2 wrong input, 3 none failed, but some judged nothing, 130 "
        "interrupted.\n");
  }

  int carry_out() override {
    leave_nothing_on_signals();
    regression_.campaign.words = words;
    if (regression_.campaign.out.empty()) regression_.campaign.out = "regression";
    const Description description =
        failed_ ? tb::regress::last_description(regression_.campaign.out) : new_description();
    return run_regression(description, regression_, failed_);
  }

 private:
  /// Adds the options that select what is run.
  std::vector<CLI::Option*> add_plan_options(CLI::App& app) {
    CLI::Option* scenarios = app.add_option("SCENARIO", request_.scenarios,
                                            "Scenarios, and folders of them (.yaml, .yml; default: ./scenarios)");
    CLI::Option* engine =
        app.add_option("--engine", request_.engines,
                       "Engines of run, and cosim for RTL of your own, separated by commas (default: skip)")
            ->delimiter(',')
            ->allow_extra_args(false);
    CLI::Option* view = app.add_option("--view", request_.views, "Views of run, separated by commas (default: pins)")
                            ->delimiter(',')
                            ->allow_extra_args(false);
    CLI::Option* seed =
        app.add_option("--seed", seeds_, "Seeds of runs with RTL, such as 1..4,7 (default: the usual one)");
    CLI::Option* set =
        app.add_option(
               "--set", set_,
               "PATH=VALUES, once for each key, lists and ranges as --param of sweep: user_cpu.fsmc.datast=2..5")
            ->allow_extra_args(false);
    CLI::Option* checks = app.add_option("--checks", description_.checks, "As for run");
    CLI::Option* shard = app.add_option("--shard", shard_, "2/5: the second fifth of the runs, always the same");
    CLI::Option* wave = app.add_option("--wave", description_.wave, "Write waves of each run: vcd, fst (default: none)")
                            ->type_name("WORD");
    CLI::Option* report = app.add_flag("--report", description_.report,
                                       "Write a page of charts and timing diagrams for each run (docs/report.md)");
    CLI::Option* keep = app.add_option(
        "--keep", keep_, "Keep log, result, wave and report of these runs: none, failed, all (default: failed)");
    add_own_rtl_options(app, own_, false);
    add_coverage_flag(app, description_);
    return {scenarios,
            engine,
            view,
            seed,
            set,
            checks,
            shard,
            wave,
            report,
            keep,
            app.get_option("--rtl"),
            app.get_option("--coverage")};
  }

  Description new_description() {
    checks_mode("dsdpv1-sim regress", description_.checks);
    if (!description_.wave.empty()) check_word("dsdpv1-sim regress: --wave", description_.wave, {"vcd", "fst"});
    if (!keep_.empty()) check_word("dsdpv1-sim regress: --keep", keep_, tb::regress::keep_words());
    const tb::regress::Shard shard = shard_.empty() ? tb::regress::Shard() : tb::regress::parse_shard(shard_);
    description_.keep = tb::regress::keep_named(keep_).value_or(tb::regress::Keep::kFailed);
    take_request();
    description_.plan = plan_of(request_, shard);
    const auto& engines = request_.engines;
    const bool cosim = std::find(engines.begin(), engines.end(), "cosim") != engines.end();
    if (cosim == own_.rtl.empty())
      throw tb::InputError("dsdpv1-sim regress: --engine cosim and --rtl go together, expected both or neither");
    if (cosim && description_.report)
      throw tb::InputError("dsdpv1-sim regress: --report is of run, --engine cosim has none, expected one of them");
    if (cosim) description_.rtl = rtl_of_regression(own_, chip_of(description_.plan));
    return description_;
  }

  /// The kinds of chips in the scenarios of cosim; those that cannot be read are refused by their runs.
  static std::string chip_of(const tb::regress::Plan& plan) {
    std::string chip, first;
    for (const Run& run : plan.runs) {
      if (run.engine != "cosim") continue;
      const std::string here = chip_of(run);
      if (!here.empty() && !chip.empty() && here != chip)
        throw tb::InputError(
            run.scenario, 0,
            "is about a " + here + ", " + first + " about a " + chip + ", expected one chip: RTL has its pins");
      if (chip.empty() && !here.empty()) chip = here, first = run.scenario;
    }
    return chip.empty() ? RtlChip().chip : chip;
  }
  static std::string chip_of(const Run& run) {
    try {
      return tb::scenario::load(run.scenario, tb::scenario::parse_settings(run.settings)).kind->name();
    } catch (const tb::InputError&) {
      return {};
    }
  }

  void take_request() {
    for (std::string& each : request_.scenarios) each = scenario_file("dsdpv1-sim regress", each);
    if (request_.scenarios.empty()) request_.scenarios = {"scenarios"};
    check_words("--engine", request_.engines, {"step", "skip", "rtl", "lockstep", "cosim"});
    check_words("--view", request_.views, {"pins", "tlm"});
    if (!seeds_.empty()) request_.seeds = tb::regress::parse_seeds(seeds_);
    for (const std::string& text : set_) request_.parameters.push_back(tb::sweep::parse_parameter(text, "--set"));
    request_.pins_only = pins_only;
  }

  tb::regress::Request request_;  ///< scenarios, engines and views by CLI11, all else by take_request
  Description description_;       ///< also checks, wave and report, and by new_description
  std::string seeds_;             ///< a range; empty: the usual one
  std::vector<std::string> set_;  ///< PATH=VALUES
  std::string keep_, shard_;      ///< empty: failed, all of it
  bool failed_ = false;           ///< what has not passed the last time
  OwnRtlArguments own_;
  RegressionArguments regression_;
};

}  // namespace

std::unique_ptr<Command> make_regress() { return std::make_unique<Regress>(); }

}  // namespace dsdpv1::app
