#pragma once
// The options of dsdpv1-sim as values.
#include <optional>
#include <string>
#include <vector>

#include "apps/wave_options.hpp"

namespace app {

// Exit codes of every command.
constexpr int kPassed = 0;         ///< all checks and expectations passed
constexpr int kFailed = 1;         ///< a check or an expectation failed
constexpr int kWrongInput = 2;     ///< one line on the error channel says where, what, and what is allowed
constexpr int kInterrupted = 130;  ///< SIGINT or SIGTERM; all files are complete up to there

struct RunArguments {
  std::string scenario, engine = "skip", view = "pins", checks = "report";
  WaveArguments wave;
  std::string log, result, trace;
  std::string difference = "lockstep.vcd";  ///< wave of a lockstep run's first difference
  std::optional<bool> progress;             ///< absent: on a terminal
  std::vector<std::string> set;             ///< PATH=VALUE: keys other than in the file
  std::optional<int> gdb;                   ///< TCP port for the debugger of the first ARM board
  bool log_whole = false, quiet = false;
};

struct SchemaArguments {
  bool markdown = false;
  std::string output;  ///< empty: standard output
};

struct GsdArguments {
  std::string file;
  std::vector<std::string> modules;
  bool json = false;
};

struct DecodeArguments {
  std::string file;  ///< empty or "-": standard input
};

int run(const RunArguments& arguments);
int schema(const SchemaArguments& arguments);
int gsd(const GsdArguments& arguments);
int decode(const DecodeArguments& arguments);

/// Throws tb::InputError unless `word` is one of `allowed`; `option` is the command and its option, "run: --engine".
void check_word(const std::string& option, const std::string& word, const std::vector<std::string>& allowed);

/// Parses the command line and carries it out; returns the exit code.
int command_line(int argc, char** argv);

}  // namespace app
