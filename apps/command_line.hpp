#pragma once
// The options of dsdpv1-sim as values.
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/options/wave_options.hpp"
#include "apps/printable_output.hpp"
#include "tb/bench/capture_recorder.hpp"

namespace dsdpv1::app {

// Exit codes of every command.
constexpr int kPassed = 0;         ///< all checks and expectations passed
constexpr int kFailed = 1;         ///< a check or an expectation failed
constexpr int kNothingJudged = 3;  ///< no data exchange, and nothing was expected
constexpr int kWrongInput = 2;     ///< one line on the error channel says where, what, and what is allowed
constexpr int kInterrupted = 130;  ///< SIGINT or SIGTERM; all files are complete up to there

struct RunArguments {
  std::string scenario, engine = "skip", view = "pins", checks;  ///< `checks` empty: as the scenario says
  WaveArguments wave;
  std::string log, result, trace, report, junit;
  std::string capture, capture_link = "profibus";
  std::string golden;                                        ///< folder of golden traces, empty: not compared with them
  unsigned fault = 0;                                        ///< of rtl_ref/faults.txt, 0: none
  std::string difference = "lockstep.vcd";                   ///< wave of a lockstep run's first difference
  std::optional<bool> progress;                              ///< absent: on a terminal
  std::vector<std::string> set;                              ///< PATH=VALUE: keys other than in the file
  std::optional<std::uint32_t> seed;                         ///< of RTL
  std::vector<std::pair<std::string, std::string>> save_at;  ///< time and file of each
  std::pair<std::string, std::string> rewind_on;             ///< code and time; empty: not wanted
  std::string restore;                                       ///< a saved run in the place of a scenario, empty: none
  std::optional<int> gdb;                                    ///< TCP port for the debugger of the first ARM board
  bool log_whole = false, quiet = false;
};

struct SchemaArguments {
  bool markdown = false;
  bool result = false, rtl_random = false;  ///< that of a result of run, or of rtl-random; else of a scenario
  std::string output;                       ///< empty: standard output
};

struct GsdArguments {
  std::string file;
  std::vector<std::string> modules;
  bool json = false;
};

struct DecodeArguments {
  std::string file;          ///< empty or "-": standard input
  std::string baud, signal;  ///< of levels; empty: found
  bool inverted = false;
  std::string table, json;  ///< files for programs, of captures
  bool quiet = false;
};

int run(const RunArguments& given);
int schema(const SchemaArguments& arguments);
int gsd(const GsdArguments& arguments);
int decode(const DecodeArguments& arguments);

/// Throws tb::InputError unless `word` is one of `allowed`; `option` is the command and its option, "run: --engine".
void check_word(const std::string& option, const std::string& word, const std::vector<std::string>& allowed);

/// The index of a baud rate of bus/baud.hpp; throws tb::InputError; `option` as above.
int baud_index(const std::string& option, const std::string& word);

/// What --capture and --capture-link ask for; `command` as "dsdpv1-sim run". Throws tb::InputError.
tb::CaptureRequest capture_request(const std::string& command, const std::string& path, const std::string& link);

/// Parses the command line and carries it out; returns the exit code. `output` is painted when the terminal or --color
/// wants it.
int command_line(int argc, char** argv, PrintableOutput& output);

}  // namespace dsdpv1::app
