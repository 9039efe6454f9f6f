#include "apps/options/common.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <thread>

#include "apps/options/words.hpp"
#include "bus/capture/link_type.hpp"
#include "io/input/input_error.hpp"

namespace dsdpv1::app {

CLI::Option* add_set_option(CLI::App& app, std::vector<std::string>& settings) {
  return app
      .add_option("--set", settings,
                  "Override the scenario, once for each key: slaves.0.user_cpu.cycle=40us, "
                  "slaves.plant.init.dpv1=true, or for every slave user_cpu.fsmc.datast=3")
      ->allow_extra_args(false);
}

CLI::Option* add_checks_option(CLI::App& app, std::string& word) {
  return app.add_option(
      "--checks", word,
      "The checks of docs/checks.md on handshake, bus timing and DPRAM: fail (exit 1 on a violation that the scenario "
      "does not allow), report (listed, and counted beside the verdict), off (default: the scenario's, else fail)");
}

void add_checks_table_option(CLI::App& app, tb::CheckRows& rows) {
  app.add_flag_callback(
      "--checks-table", [&rows] { rows = tb::CheckRows::kAll; },
      "Show in the summary a row for each check, not only for violated ones, and how long each slave waited");
}

std::optional<tb::ChecksMode> checks_mode(const std::string& command, const std::string& word) {
  using Mode = tb::ChecksMode;
  if (word.empty()) return std::nullopt;
  return value_of<Mode>(command + ": --checks", word,
                        {{"fail", Mode::kFail}, {"report", Mode::kReport}, {"off", Mode::kOff}});
}

CLI::Option* add_log_options(CLI::App& app, std::string& log, bool& whole, const char* log_help,
                             const char* whole_help) {
  CLI::Option* option = app.add_option("--log", log, log_help);
  return app.add_flag("--log-whole", whole, whole_help)->needs(option);
}

void add_report_option(CLI::App& app, std::string& report) {
  app.add_option(
      "--report", report,
      "Write the run as one HTML page with charts and timing diagrams, which needs no network (docs/report.md)");
}

void add_capture_options(CLI::App& app, CaptureArguments& arguments) {
  CLI::Option* capture =
      app.add_option("--capture", arguments.file,
                     "Write every telegram with its time as FILE.pcapng, for Wireshark and tshark (docs/captures.md)");
  app.add_option("--capture-link", arguments.link,
                 "Its link type: profibus (257), or user0 to user15 for a Wireshark that does not know 257")
      ->capture_default_str()
      ->needs(capture);
}

tb::CaptureRequest capture_request(const std::string& command, const CaptureArguments& arguments) {
  const std::optional<std::uint16_t> number = bus::capture::link_type(arguments.link);
  if (!number)
    throw tb::InputError(command + ": --capture-link is " + arguments.link + ", expected " + bus::capture::kLinkWords);
  return {arguments.file, *number, "dsdpv1-sim " DSDPV1_VERSION};
}

void add_quiet_option(CLI::App& app, bool& quiet) { app.add_flag("--quiet,-q", quiet, "Show no table at the end"); }

void add_output_options(CLI::App& app, std::optional<bool>& progress, bool& quiet) {
  app.add_flag_callback(
      "--progress", [&progress] { progress = true; }, "Show a progress bar (on a terminal it is shown anyway)");
  app.add_flag_callback(
      "--no-progress", [&progress] { progress = false; }, "Show no progress bar");
  add_quiet_option(app, quiet);
}

bool shows_progress(const std::optional<bool>& progress) { return progress.value_or(isatty(STDERR_FILENO) != 0); }

unsigned at_a_time(unsigned jobs) { return jobs != 0 ? jobs : std::max(1U, std::thread::hardware_concurrency()); }

}  // namespace dsdpv1::app
