#pragma once
// Options that several commands have.
#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

#include "tb/bench/capture_recorder.hpp"
#include "tb/bench/verdict.hpp"
#include "tb/report/check_report.hpp"

namespace dsdpv1::app {

/// PATH=VALUE, each a key of the scenario.
CLI::Option* add_set_option(CLI::App& app, std::vector<std::string>& settings);

CLI::Option* add_checks_option(CLI::App& app, std::string& word);
/// --checks-table; `rows`: those of the summary.
void add_checks_table_option(CLI::App& app, tb::CheckRows& rows);
/// Absent for an empty word: as the scenario says. Throws tb::InputError; `command` as "dsdpv1-sim run".
std::optional<tb::ChecksMode> checks_mode(const std::string& command, const std::string& word);

/// Help texts of run, to which other commands refer.
constexpr const char* kLogHelp =
    "Everything that happened, one line a thing; FILE.jsonl: a JSON object a line, for programs (docs/log.md)";
constexpr const char* kLogWholeHelp =
    "All bytes of telegrams and data in the log, not only the first 32 of each; FILE.jsonl has them anyway";
/// --log and --log-whole, which is returned.
CLI::Option* add_log_options(CLI::App& app, std::string& log, bool& whole, const char* log_help = kLogHelp,
                             const char* whole_help = kLogWholeHelp);
void add_report_option(CLI::App& app, std::string& report);

struct CaptureArguments {
  std::string file;  ///< empty: none
  std::string link = "profibus";
};
void add_capture_options(CLI::App& app, CaptureArguments& arguments);
/// Throws tb::InputError; `command` as "dsdpv1-sim run".
tb::CaptureRequest capture_request(const std::string& command, const CaptureArguments& arguments);

void add_quiet_option(CLI::App& app, bool& quiet);
/// --progress, --no-progress and --quiet. `progress`: absent when none of them is given.
void add_output_options(CLI::App& app, std::optional<bool>& progress, bool& quiet);
/// Without a word for or against it a progress bar is shown on a terminal.
bool shows_progress(const std::optional<bool>& progress);

/// Processes or threads for --jobs; 0: one a processor.
unsigned at_a_time(unsigned jobs);

}  // namespace dsdpv1::app
