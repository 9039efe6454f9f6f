// replay: plays a capture to the model, which replaces one of its slaves.
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>

#include "apps/commands/capture_file.hpp"
#include "apps/commands/command.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/common.hpp"
#include "apps/options/outputs.hpp"
#include "apps/options/wave_options.hpp"
#include "apps/options/words.hpp"
#include "bus/baud.hpp"
#include "bus/printable.hpp"
#include "cosim/lockstep_execution.hpp"
#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"
#include "lab/replay/replay.hpp"
#include "lab/replay/report.hpp"
#include "tb/report/progress.hpp"
#include "tb/report/result_fields.hpp"

namespace dsdpv1::app {
namespace {

using tb::replay::Recording;

const std::string kReplay = "dsdpv1-sim replay";
constexpr bus::Tick kAnyTime = std::numeric_limits<bus::Tick>::min();

int status_of(const tb::replay::Result& result, const tb::RunResult& run) {
  if (result.compared() == 0) return kNothingJudged;
  if (!result.equal() || verdict(run) == tb::Verdict::kFailed) return kFailed;
  return result.interrupted ? kInterrupted : kPassed;
}

class Replay : public Command {
 public:
  Replay() : Command("replay", "Play a capture to the model as one of its slaves, and compare the answers") {}

  void options(CLI::App& app) override {
    add_what_is_played(app);
    add_how_it_is_compared(app);
    app.add_option("--table", table_, "Write each request with both answers, separated by tabs");
    app.add_option("--json", json_, "The result for programs");
    add_wave_options(app, wave_);
    add_log_options(app, run_.log, run_.log_whole);
    app.add_option("--result", result_, "Write the run's measurements as JSON, as for run");
    add_checks_option(app, checks_);
    add_capture_options(app, capture_out_);
    add_output_options(app, progress_, quiet_);
    app.footer(
        "\nExamples:\n"
        "  dsdpv1-sim replay plant.pcapng --as 5\n"
        "  dsdpv1-sim replay plant.sr --signal D2 --as 5 --gsd my_device.gsd --table plant.tsv\n"
        "  dsdpv1-sim replay board.csv --as 5 --tsdr-tolerance 1 --log board.log --wave board.fst\n"
        "  dsdpv1-sim replay plant.pcapng --as 5 --scenario my.yaml --from 2s --to 3s --json plant.json\n"
        "docs/replay.md explains them.\n"
        "\nExit codes: 0 equal, 1 different or violated, 2 wrong input, 3 nothing could be compared, 130 "
        "interrupted.\n");
  }

  int carry_out() override {
    leave_nothing_on_signals();
    take_words();
    const auto given = given_scenario();
    const Recording recording = record();
    const tb::replay::Firmware firmware = tb::replay::firmware_of(recording, told_kind(given, recording));
    const tb::scenario::Scenario scenario = scenario_of(given, recording, firmware);
    take_run_words(kinds(scenario));
    check_files(scenario);
    tb::replay::Replay replay(recording, firmware, scenario, options_, run_, execution());
    tb::ShareProgress progress(shows_progress(progress_));
    catch_signals();
    const tb::replay::Result result = replay.run([&progress](double share) {
      progress.show(share);
      return !interrupted();
    });
    progress.clear();
    write_files(replay, result, kinds(scenario));
    if (!quiet_) std::cout << tb::replay::text(result, replay.bench_result()) << std::flush;
    return status_of(result, replay.bench_result());
  }

 private:
  void add_what_is_played(CLI::App& app) {
    app.add_option("CAPTURE", capture_,
                   "pcapng, pcap, VCD or FST of any simulator, a session of sigrok, CSV of a logic analyser, a log of "
                   "run or serve with all bytes")
        ->required();
    app.add_option("--as", slave_, "Address of the slave that the model replaces")
        ->required()
        ->check(CLI::Range(0, 126));
    app.add_option("--gsd", gsd_, "The slave's GSD file, with its ident number and limits");
    CLI::Option* chip =
        app.add_option("--chip", chip_,
                       "The model: a kind of chip of scenarios (default: the first of them that can be the slave)")
            ->type_name("WORD");
    app.add_option("--scenario", scenario_,
                   "Use this scenario's slave with this address (or the only one), and its user CPU, instead of the "
                   "capture's data")
        ->excludes(chip);
    app.add_option("--inputs", inputs_,
                   "Data of the user CPU: recorded (inputs and diagnoses from the slave's answers) or scenario "
                   "(default: scenario with --scenario, else recorded)");
  }

  void add_how_it_is_compared(CLI::App& app) {
    app.add_option("--tsdr-tolerance", options_.judge.tsdr.tolerance_bits,
                   "Largest difference of both TSDRs in bit times (default: both from min_TSDR to max_TSDR)")
        ->check(CLI::Range(0.0, 10'000.0));
    app.add_option("--from", from_, "Compare from this time of the capture on; earlier telegrams are also played");
    app.add_option("--to", to_, "End at this time of the capture");
    app.add_option(
        "--baud", baud_,
        "Play the telegrams of this baud rate only (default: the capture's rates, or the one detected in a recording)");
    app.add_option("--signal", line_.signal, "As for decode");
    app.add_flag("--invert", line_.inverted, "As for decode");
    app.add_flag("--no-lead-in", no_lead_in_,
                 "Play nothing before the capture: the model must find its baud rate and its parameters there");
    app.add_option("--engine", run_.engine_name, "step, skip or rtl (the reference RTL), as for run")
        ->capture_default_str();
  }

  void take_words() {
    if (!inputs_.empty()) check_word(kReplay + ": --inputs", inputs_, {"recorded", "scenario"});
    std::vector<std::string> kinds;
    for (const tb::ChipKind* each : tb::chip_kinds()) kinds.emplace_back(each->name());
    if (!chip_.empty()) check_word(kReplay + ": --chip", chip_, kinds);
    if (inputs_ == "scenario" && scenario_.empty())
      throw tb::InputError(kReplay + ": --inputs scenario needs --scenario");
    if (!from_.empty()) options_.judge.from = time_of(kReplay + ": --from", from_, kAnyTime);
    options_.judge.supplied = inputs_.empty() ? scenario_.empty() : inputs_ == "recorded";
    options_.lead_in = !no_lead_in_;
  }

  void take_run_words(const tb::ChipKinds& kinds) {
    check_word(kReplay + ": --engine", run_.engine_name, {"step", "skip", "rtl"});
    if (wave_.inside && run_.engine_name == "rtl")
      throw tb::InputError(kReplay + ": --wave-inside is about the model, it needs --engine step or skip");
    run_.engine = run_.engine_name == "step" ? tb::Engine::kStep : tb::Engine::kSkip;
    run_.wave = wave_options(kReplay, wave_, kinds);
    run_.checks = checks_mode(kReplay, checks_);
    run_.capture = capture_request(kReplay, capture_out_);
  }

  /// That of --scenario.
  std::optional<tb::scenario::Scenario> given_scenario() const {
    if (scenario_.empty()) return std::nullopt;
    return tb::scenario::load(scenario_);
  }

  Recording record() const {
    CaptureFile file(capture_);
    bus::capture::LogicSettings line = line_;
    if (!baud_.empty()) line.baud = baud_index(kReplay + ": --baud", baud_);
    tb::replay::Recorder recorder(file.name(), static_cast<std::uint8_t>(slave_), line.baud);
    const bus::Tick end =  // what is after it need not be kept
        to_.empty() ? bus::kNever : time_of(kReplay + ": --to", to_, kAnyTime);
    line.on_change = [&recorder, end](bus::Tick at, bool level) {
      if (at <= end) recorder.level(at, level);
    };
    file.read(line, [&recorder, &file, end](const bus::capture::CapturedTelegram& telegram) {
      if (telegram.missing != 0)
        throw tb::InputError(file.name(), telegram.line,
                             "has not all bytes, expected a log with all of them (--log-whole, .jsonl)");
      if (telegram.start <= end) recorder.telegram(telegram);
    });
    Recording recording = recorder.finish();
    if (no_lead_in_) tb::replay::check_comparable(recording);
    return recording;
  }

  /// That of --scenario or --chip; null without them.
  const tb::ChipKind* told_kind(const std::optional<tb::scenario::Scenario>& given, const Recording& recording) const {
    if (given) return tb::replay::alone(*given, recording).slaves.front().kind;
    return chip_.empty() ? nullptr : tb::find_chip_kind(chip_);
  }

  tb::scenario::Scenario scenario_of(const std::optional<tb::scenario::Scenario>& given, const Recording& recording,
                                     const tb::replay::Firmware& firmware) const {
    if (given) {
      tb::scenario::Scenario alone = tb::replay::alone(*given, recording);
      if (options_.judge.supplied) tb::replay::take_inputs_of(firmware, alone);
      return alone;
    }
    if (gsd_.empty()) return tb::replay::scenario_of(recording, firmware, "", kind(firmware));
    tb::read_file(gsd_, tb::kGsdFile);  // says what is wrong with the name that was given
    return tb::replay::scenario_of(recording, firmware, std::filesystem::absolute(gsd_).string(), kind(firmware));
  }

  const tb::ChipKind& kind(const tb::replay::Firmware& firmware) const {
    return chip_.empty() ? tb::replay::kind_for(firmware) : *tb::find_chip_kind(chip_);
  }

  std::unique_ptr<tb::Execution> execution() const {
    if (run_.engine_name == "rtl") return cosim::make_rtl_execution(cosim::reference_rtl());
    return tb::make_pin_execution();
  }

  void check_files(const tb::scenario::Scenario& scenario) const {
    std::vector<NamedFile> inputs =
        scenario_.empty() ? std::vector<NamedFile>() : scenario_inputs(scenario_, scenario.files);
    inputs.push_back({"the capture", capture_ == "-" ? "" : capture_});
    inputs.push_back({"--gsd", gsd_});
    std::vector<NamedFile> outputs = wave_files(kReplay, wave_.file, wave_.save);
    outputs.insert(outputs.end(), {{"--log", run_.log},
                                   {"--result", result_},
                                   {"--capture", capture_out_.file},
                                   {"--json", json_},
                                   {"--table", table_}});
    check_outputs(kReplay, inputs, outputs);
  }

  void write_files(const tb::replay::Replay& replay, const tb::replay::Result& result,
                   const tb::ChipKinds& kinds) const {
    if (wave_.save) write_save_files(wave_.file, kinds);
    write_wanted(json_, tb::replay::json(result));
    write_wanted(table_, tb::replay::table(result));
    write_wanted(result_, tb::result_json(replay.bench_result()));
    if (replay.wave_is_empty()) std::cerr << nothing_recorded(wave_) << '\n';
  }

  std::string capture_;
  int slave_ = -1;  ///< address
  std::string gsd_, scenario_;
  std::string chip_;                  ///< name of its kind; empty: the first
  std::string inputs_;                ///< recorded or scenario; empty: recorded without a scenario
  std::string baud_;                  ///< empty: found
  bus::capture::LogicSettings line_;  ///< as of decode
  std::string from_, to_;             ///< times of the capture; empty: all of it
  bool no_lead_in_ = false;
  tb::replay::ReplayOptions options_;
  std::string checks_;  ///< empty: as the scenario says
  WaveArguments wave_;
  CaptureArguments capture_out_;
  tb::RunOptions run_;
  std::string json_, table_, result_;  ///< files, empty: not wanted
  std::optional<bool> progress_;
  bool quiet_ = false;
};

}  // namespace

std::unique_ptr<Command> make_replay() { return std::make_unique<Replay>(); }

}  // namespace dsdpv1::app
