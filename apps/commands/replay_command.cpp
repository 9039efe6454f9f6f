// replay: a capture played to the model in the place of one of its slaves.
#include "apps/commands/replay_command.hpp"

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <utility>

#include "apps/command_line.hpp"
#include "apps/commands/capture_file.hpp"
#include "apps/hand_over.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/checks.hpp"
#include "apps/options/outputs.hpp"
#include "bus/baud.hpp"
#include "bus/printable.hpp"
#include "bus/telegram/telegram_text.hpp"
#include "cosim/lockstep_execution.hpp"
#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"
#include "io/input/units.hpp"
#include "lab/replay/replay.hpp"
#include "lab/replay/report.hpp"
#include "tb/report/progress.hpp"
#include "tb/report/result_fields.hpp"

namespace dsdpv1::app {
namespace {

using tb::replay::Recording;

constexpr const char* kCommand = "dsdpv1-sim replay";

std::optional<bus::Tick> time_of(const std::string& option, const std::string& text) {
  if (text.empty()) return std::nullopt;
  if (const std::optional<bus::Tick> time = tb::parse_time(text)) return time;
  throw tb::InputError(std::string(kCommand) + ": " + option + " is " + text + ", allowed is " + tb::kTimeForm);
}

/// The telegrams of a log, which tells each when it has ended.
void read_log(CaptureFile& file, const bus::capture::TakeTelegram& take, std::optional<int> baud) {
  bus::TelegramText text;
  std::string error;
  if (!bus::read_telegram_text(file.stream(), file.name(), text, error)) throw tb::InputError(error);
  if (text.logged.empty())
    throw tb::InputError(
        file.name(), 0,
        "is no capture with times, allowed are pcapng, pcap, VCD, FST, a session of sigrok, CSV, a log");
  if (!baud) throw tb::InputError(file.name(), 0, "is a log, which does not say its baud rate, name it with --baud");
  std::size_t byte = 0;
  for (const auto& [line, logged] : text.logged) {
    bus::capture::CapturedTelegram telegram;
    while (text.lines[byte] < line) ++byte;
    for (; byte < text.bytes.size() && text.lines[byte] == line; ++byte) telegram.bytes.push_back(text.bytes[byte]);
    if (telegram.bytes.size() < logged.whole_length)
      throw tb::InputError(file.name(), line,
                           "has not all bytes, allowed is a log with all of them (--log-whole, .jsonl)");
    telegram.baud = baud;
    telegram.end = std::llround(std::stod(logged.at_ns) * static_cast<double>(bus::kTicksPerNs));
    telegram.start =
        telegram.end - static_cast<bus::Tick>(telegram.bytes.size()) * bus::kCharacterBits * bus::baud(*baud).bit;
    take(telegram);
  }
}

Recording record(const ReplayArguments& arguments) {
  CaptureFile file(arguments.capture);
  std::optional<int> baud;
  if (!arguments.baud.empty()) baud = baud_index("replay: --baud", arguments.baud);
  tb::replay::Recorder recorder(file.name(), static_cast<std::uint8_t>(arguments.slave), baud);
  bus::capture::LogicSettings settings;
  settings.baud = baud;
  settings.signal = arguments.signal;
  settings.inverted = arguments.inverted;
  const bus::Tick end = time_of("--to", arguments.to).value_or(bus::kNever);  // what is after it need not be kept
  settings.on_change = [&recorder, end](bus::Tick at, bool level) {
    if (at <= end) recorder.level(at, level);
  };
  const auto take = [&recorder, end](const bus::capture::CapturedTelegram& telegram) {
    if (telegram.start <= end) recorder.telegram(telegram);
  };
  if (file.form() == CaptureForm::kText)
    read_log(file, take, baud);
  else
    file.read(settings, take);
  Recording recording = recorder.finish();
  if (arguments.no_lead_in) tb::replay::check_comparable(recording);
  return recording;
}

/// That of --scenario.
std::optional<tb::scenario::Scenario> given_scenario(const ReplayArguments& arguments) {
  if (arguments.scenario.empty()) return std::nullopt;
  return load_scenario(arguments.scenario);
}

tb::scenario::Scenario scenario_of(const ReplayArguments& arguments, const std::optional<tb::scenario::Scenario>& given,
                                   const Recording& recording, const tb::replay::Firmware& firmware) {
  if (given) return tb::replay::alone(*given, recording);
  if (arguments.gsd.empty()) return tb::replay::scenario_of(recording, firmware, "");
  tb::read_file(arguments.gsd, tb::kGsdFile);  // says what is wrong with the name that was given
  return tb::replay::scenario_of(recording, firmware, std::filesystem::absolute(arguments.gsd).string());
}

tb::replay::ReplayOptions options_of(const ReplayArguments& arguments) {
  if (!arguments.inputs.empty()) check_word("replay: --inputs", arguments.inputs, {"recorded", "scenario"});
  if (arguments.inputs == "scenario" && arguments.scenario.empty())
    throw tb::InputError(std::string(kCommand) + ": --inputs scenario needs --scenario");
  tb::replay::ReplayOptions options;
  options.judge.tsdr.tolerance_bits = arguments.tolerance;
  options.judge.from = time_of("--from", arguments.from);
  options.judge.supplied = arguments.inputs.empty() ? arguments.scenario.empty() : arguments.inputs == "recorded";
  options.lead_in = !arguments.no_lead_in;
  return options;
}

tb::RunOptions run_options(const ReplayArguments& arguments, const tb::ChipKind& kind) {
  check_word("replay: --engine", arguments.engine, {"step", "skip", "rtl"});
  if (arguments.wave.inside && arguments.engine == "rtl")
    throw tb::InputError(std::string(kCommand) +
                         ": --wave-inside is about the model, allowed with it is --engine step or skip");
  tb::RunOptions options;
  options.engine = arguments.engine == "step" ? tb::Engine::kStep : tb::Engine::kSkip;
  options.engine_name = arguments.engine;
  options.wave = wave_options(kCommand, arguments.wave, kind);
  options.log = arguments.log;
  options.log_whole = arguments.log_whole;
  options.checks = checks_mode("replay", arguments.checks);
  options.capture = capture_request(kCommand, arguments.capture_out, arguments.capture_link);
  return options;
}

std::unique_ptr<tb::Execution> execution_of(const ReplayArguments& arguments) {
  if (arguments.engine == "rtl") return cosim::make_rtl_execution(cosim::reference_rtl());
  return tb::make_pin_execution();
}

void check_files(const ReplayArguments& arguments, const tb::scenario::Scenario& scenario) {
  std::vector<NamedFile> inputs =
      arguments.scenario.empty() ? std::vector<NamedFile>() : scenario_inputs(arguments.scenario, scenario.files);
  inputs.push_back({"the capture", arguments.capture == "-" ? "" : arguments.capture});
  inputs.push_back({"--gsd", arguments.gsd});
  std::vector<NamedFile> outputs = wave_files(kCommand, arguments.wave.file, arguments.wave.save);
  outputs.insert(outputs.end(), {{"--log", arguments.log},
                                 {"--result", arguments.result},
                                 {"--capture", arguments.capture_out},
                                 {"--json", arguments.json},
                                 {"--table", arguments.table}});
  check_outputs(kCommand, inputs, outputs);
}

int status_of(const tb::replay::Result& result, const tb::RunResult& run) {
  if (result.compared() == 0) return kNothingJudged;
  if (!result.equal() || verdict(run) == tb::Verdict::kFailed) return kFailed;
  return result.interrupted ? kInterrupted : kPassed;
}

}  // namespace

int replay(const ReplayArguments& arguments) {
  leave_nothing_on_signals();
  const tb::replay::ReplayOptions options = options_of(arguments);
  const auto given =
      given_scenario(arguments);  // before the capture, which may be a pipe and another program's to read
  const Recording recording = record(arguments);
  const tb::replay::Firmware firmware = tb::replay::firmware_of(recording);
  const tb::scenario::Scenario scenario = scenario_of(arguments, given, recording, firmware);
  tb::RunOptions run = run_options(arguments, *scenario.kind);
  check_files(arguments, scenario);
  tb::replay::Replay replay(recording, firmware, scenario, options, std::move(run), execution_of(arguments));
  tb::ShareProgress progress(arguments.progress.value_or(isatty(STDERR_FILENO) != 0));
  catch_signals();
  const tb::replay::Result result = replay.run([&progress](double share) {
    progress.show(share);
    return !interrupted();
  });
  progress.clear();
  if (arguments.wave.save) write_save_files(arguments.wave.file, *scenario.kind);
  write_wanted(arguments.json, tb::replay::json(result));
  write_wanted(arguments.table, tb::replay::table(result));
  write_wanted(arguments.result, tb::result_json(replay.bench_result()));
  if (replay.wave_is_empty()) std::cerr << nothing_recorded(arguments.wave) << '\n';
  if (!arguments.quiet) std::cout << tb::replay::text(result, replay.bench_result()) << std::flush;
  return status_of(result, replay.bench_result());
}

}  // namespace dsdpv1::app
