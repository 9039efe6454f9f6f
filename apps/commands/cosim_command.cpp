// cosim: compares the user's RTL with the model, in a scenario or by a stimulus.
#include <iostream>
#include <utility>

#include "apps/commands/command.hpp"
#include "apps/commands/rtl_random.hpp"
#include "apps/commands/scenario_run.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/outputs.hpp"
#include "apps/options/scenario_files.hpp"
#include "cosim/joined_wave.hpp"
#include "io/input/input_error.hpp"

namespace dsdpv1::app {
namespace {

constexpr const char* kCosim = "dsdpv1-sim cosim";

class Cosim : public Command {
 public:
  Cosim() : Command("cosim", "Build your RTL with Verilator and compare it with the model") {
    run_.engine = "lockstep";
  }

  void options(CLI::App& app) override {
    app.add_option("SCENARIO", run_.scenario, "Scenario in YAML");
    CLI::Option* replay =
        app.add_option("--replay", replay_, "Play a stimulus file instead: a case of rtl-random, with its --set");
    add_chip_option(app, chip_)->needs(replay);
    add_own_rtl_options(app, own_, true);
    add_coverage_option(app, own_);
    app.add_option("--difference", run_.difference, "Write a wave of both sides' pins when they differ")
        ->capture_default_str();
    CLI::Option* wave =
        app.add_option("--wave", run_.wave.file,
                       "Write a wave of the run with internal signals of your RTL and the model: FILE.vcd or FILE.fst");
    app.add_option("--wave-from", run_.wave.from, "Only from this time on")->needs(wave)->excludes(replay);
    app.add_option("--wave-to", run_.wave.to, "Only up to this time")->needs(wave)->excludes(replay);
    add_wave_save_option(app, wave_save_, wave);
    add_log_options(app, run_.log, run_.log_whole)->excludes(replay);
    app.add_option("--stimulus", stimulus_,
                   "Write what the chip got up to a difference as a stimulus, shortened, if it shows it without the "
                   "scenario")
        ->excludes(replay);
    app.add_option("--result", run_.result, "Result, measurements and the first difference as JSON");
    add_checks_option(app, run_.checks)->excludes(replay);
    add_set_option(app, run_.set);
    app.footer(
        "\nExamples:\n  dsdpv1-sim cosim --rtl examples/own_rtl --top board_chip --pins examples/own_rtl/pins.yaml "
        "scenarios/two_slaves.yaml\n"
        "  dsdpv1-sim cosim --rtl my_chip --top chip my.yaml --wave inside.fst --wave-from 1.6ms --log my.log --result "
        "my.json\n"
        "  dsdpv1-sim cosim --rtl my_chip --top chip --replay lockstep.stimulus --chip dsdpv1_rsu --wave inside.fst\n"
        "\nExit codes: 0 no difference and the scenario passed, 1 otherwise, 2 wrong input, 3 nothing was judged, 130 "
        "interrupted.\n");
  }

  int carry_out() override {
    if (run_.scenario.empty() == replay_.empty())
      throw tb::InputError(std::string(kCosim) + (replay_.empty()
                                                      ? ": a scenario is missing (FILE.yaml, or --replay FILE)"
                                                      : ": expected one of SCENARIO and --replay"));
    run_.scenario = scenario_file(kCosim, run_.scenario);
    if (!replay_.empty()) return rtl_random(arguments_of_stimulus());
    leave_nothing_on_signals();
    RunRequest request{run_, {}, options_of(run_), {}, {}};
    request.scenario = tb::scenario::load(run_.scenario, tb::scenario::parse_settings(run_.set));
    request.options.wave = wave_options(kCosim, run_.wave, kinds(request.scenario));
    request.options.wave.inside = true;
    check_files(request.scenario);
    check_one_chip(request.scenario, "RTL");
    CoverageFile coverage(own_);
    const OwnRtl own =
        build_own_rtl(own_, kCosim, *request.scenario.kind, *request.scenario.chip, !run_.wave.file.empty());
    const int status = run_own_rtl(std::move(request), own);
    coverage.add(own);
    coverage.write();
    return status;
  }

 private:
  /// The stimulus of --replay, as rtl-random plays it.
  RtlRandomArguments arguments_of_stimulus() const {
    RtlRandomArguments stimulus;
    stimulus.command = kCosim;
    stimulus.chip = chip_;
    stimulus.replay = replay_;
    stimulus.own = own_;
    stimulus.set = run_.set;
    stimulus.difference = run_.difference;
    stimulus.wave = run_.wave.file;
    stimulus.wave_save = wave_save_;
    stimulus.log = run_.log;
    stimulus.result = run_.result;
    return stimulus;
  }

  void check_files(const tb::scenario::Scenario& scenario) const {
    std::vector<NamedFile> inputs = scenario_inputs(run_.scenario, scenario.files);
    for (NamedFile& own : own_inputs(own_)) inputs.push_back(std::move(own));
    std::vector<NamedFile> outputs = wave_files(kCosim, run_.wave.file, wave_save_);
    outputs.insert(outputs.end(), {{"--difference", run_.difference},
                                   {"--log", run_.log},
                                   {"--stimulus", stimulus_},
                                   {"--result", run_.result},
                                   {"--coverage", own_.coverage}});
    check_outputs(kCosim, inputs, outputs);
  }

  /// In lockstep with the user's RTL; a wave shows its internal signals beside the model's.
  int run_own_rtl(RunRequest request, const OwnRtl& own) const {
    cosim::LockstepOptions lockstep;
    lockstep.tolerances = own.map.tolerances;
    lockstep.keeps_inputs = !stimulus_.empty();
    if (run_.wave.file.empty()) {
      LockstepOutcome outcome = run_lockstep(
          request, [&own](auto&&...) { return own.make(std::nullopt); }, lockstep);
      write_stimulus(request, std::move(outcome), own);
      return outcome.status;
    }
    cosim::JoinedWave wave(run_.wave.file, own_.build);
    const tb::WaveSelection window = request.options.wave.selection;
    request.options.wave.path = wave.model();
    const auto make = [&](const std::string& name, const auto&...) {
      return own.make(wave.trace(name, window.from, window.to));
    };
    LockstepOutcome outcome = run_lockstep(request, make, lockstep);
    wave.finish(outcome.difference);
    write_stimulus(request, std::move(outcome), own);
    if (wave_save_) write_save_files(run_.wave.file, kinds(request.scenario));
    std::cout << "with the inside   " << run_.wave.file << '\n' << std::flush;
    return outcome.status;
  }

  /// The file of --stimulus.
  void write_stimulus(const RunRequest& request, LockstepOutcome&& outcome, const OwnRtl& own) const {
    if (stimulus_.empty() || !outcome.difference) return;
    const tb::scenario::Scenario& scenario = request.scenario;
    if (scenario.kind->random() == nullptr) {
      std::cout << "no stimulus       there is no player of stimuli for chips of the kind " << scenario.kind->name()
                << '\n';
      return;
    }
    RtlRandomArguments arguments;
    arguments.chip.chip = scenario.kind->name();
    arguments.own = own_;
    arguments.stimulus = stimulus_;
    app::write_stimulus(arguments,
                        {std::move(outcome.inputs), *outcome.difference, scenario.chip,
                         cosim::chip_settings_of(run_.scenario, run_.set, *scenario.kind, *scenario.chip)},
                        own);
  }

  RunArguments run_;
  std::string stimulus_;
  bool wave_save_ = false;  ///< once the wave has both sides, so not the run's
  std::string replay_;      ///< a stimulus file instead of a scenario
  RtlChip chip_;            ///< ... for this kind of chip
  OwnRtlArguments own_;
};

}  // namespace

std::unique_ptr<Command> make_cosim() { return std::make_unique<Cosim>(); }

}  // namespace dsdpv1::app
