// serve: a scenario's segment behind a pseudo-terminal, a TCP port or a serial port.
#include "apps/commands/serve_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>

#include "apps/command_line.hpp"
#include "apps/hand_over.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/checks.hpp"
#include "apps/options/outputs.hpp"
#include "bus/baud.hpp"
#include "bus/printable.hpp"
#include "io/input/input_error.hpp"
#include "io/input/units.hpp"
#include "io/output/output_file.hpp"
#include "tb/bench/bench.hpp"
#include "tb/report/html/report_file.hpp"
#include "tb/report/result_fields.hpp"
#include "tb/report/run_junit.hpp"
#include "tb/report/summary.hpp"
#include "tb/serve/ports.hpp"
#include "tb/serve/real_time_execution.hpp"

namespace dsdpv1::app {
namespace {

/// Longer than any computer stays up, and far from the end of 64 bits.
constexpr tb::Tick kOpenEnd = 5LL * 365 * 24 * 3600 * bus::kTicksPerSecond;

int chosen_baud(const tb::scenario::Scenario& scenario, const std::string& word) {
  if (word.empty()) return scenario.baud;
  return baud_index("serve: --baud", word);
}

tb::Tick chosen_end(const std::string& text) {
  if (text.empty()) return kOpenEnd;
  const std::optional<tb::Tick> time = tb::parse_time(text);
  if (!time || *time <= 0)
    throw tb::InputError(fmt::format("dsdpv1-sim serve: --for is {}, allowed is {}", text, tb::kTimeForm));
  return *time;
}

std::unique_ptr<tb::serve::HostConnection> open_port(const ServeArguments& arguments, int baud) {
  const int bits_per_second = static_cast<int>(bus::kTicksPerSecond / bus::baud(baud).bit);
  if (!arguments.serial.empty()) return tb::serve::open_serial({arguments.serial, bits_per_second, arguments.rts});
  if (arguments.tcp >= 0)
    return tb::serve::open_tcp(arguments.bind, arguments.tcp, std::chrono::seconds(arguments.turn));
  return tb::serve::open_pty(arguments.link, bits_per_second);
}

tb::RunOptions options_of(const ServeArguments& arguments, const tb::ChipKind& kind) {
  tb::RunOptions options;
  options.wave = wave_options("dsdpv1-sim serve", arguments.wave, kind);
  options.log = arguments.log;
  options.log_whole = arguments.log_whole;
  options.capture = capture_request("dsdpv1-sim serve", arguments.capture, arguments.capture_link);
  options.checks = checks_mode("serve", arguments.checks);
  options.open_ended = true;
  return options;
}

}  // namespace

int serve(const ServeArguments& arguments) {
  leave_nothing_on_signals();
  tb::scenario::Scenario scenario = load_scenario(arguments.scenario, tb::scenario::parse_settings(arguments.set));
  scenario.baud = chosen_baud(scenario, arguments.baud);
  scenario.end = chosen_end(arguments.duration);
  tb::RunOptions options = options_of(arguments, *scenario.kind);
  std::vector<NamedFile> outputs = wave_files("dsdpv1-sim serve", arguments.wave.file, arguments.wave.save);
  outputs.push_back({"--log", arguments.log});
  outputs.push_back({"--result", arguments.result});
  outputs.push_back({"--report", arguments.report});
  outputs.push_back({"--junit", arguments.junit});
  outputs.push_back({"--capture", arguments.capture});
  check_outputs("dsdpv1-sim serve", scenario_inputs(arguments.scenario, scenario.files), outputs);
  std::optional<tb::OutputFile> result_file, junit_file;
  if (!arguments.result.empty()) result_file.emplace(arguments.result);
  if (!arguments.junit.empty()) junit_file.emplace(arguments.junit);
  std::optional<tb::html::ReportFile> report_file;
  if (!arguments.report.empty()) report_file.emplace(arguments.report, scenario, options);

  auto port = open_port(arguments, scenario.baud);
  const std::string name = port->name();
  auto made = std::make_unique<tb::serve::RealTimeExecution>(std::move(port), scenario.baud);
  tb::serve::RealTimeExecution& execution = *made;
  tb::Bench bench(scenario, options, std::move(made));
  if (!arguments.log.empty()) std::cerr << "serve: the log grows as " << bench.log_grows_at() << '\n';
  execution.join();
  execution.say = [&bench](tb::Tick at, const std::string& text) {
    std::cerr << "serve: " << text << '\n';
    bench.log(at, "host", "serve", text);
  };
  catch_signals();
  std::cout << "serving \"" << bus::printable(scenario.name) << "\" at " << bus::baud(scenario.baud).name << " on "
            << name << "; Ctrl-C ends\n"
            << std::flush;

  tb::RunResult result = bench.run([](tb::Tick) { return !interrupted(); });
  if (arguments.wave.save) write_save_files(arguments.wave.file, *scenario.kind);
  if (bench.wave_is_empty()) std::cerr << nothing_recorded(arguments.wave) << '\n';
  result.pacing = execution.pacing();
  if (result_file) {
    result_file->write(tb::result_json(result));
    result_file->commit();
  }
  if (junit_file) {
    junit_file->write(tb::junit("dsdpv1-sim serve", tb::run_cases(result)));
    junit_file->commit();
  }
  if (report_file) report_file->write(result, DSDPV1_VERSION);
  if (!arguments.quiet) std::cout << tb::summary(result) << std::flush;
  return exit_code(verdict(result));
}

}  // namespace dsdpv1::app
