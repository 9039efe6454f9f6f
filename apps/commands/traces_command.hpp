#pragma once
// traces: golden traces checked, made again, listed, and turned into waves.
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace dsdpv1::app {

struct TracesArguments {
  std::string action;                  ///< check, regenerate, list, wave
  std::vector<std::string> scenarios;  ///< names or paths; empty: all
  std::string folder;                  ///< of the goldens; empty: traces of the source tree
  std::string engine = "skip";
  unsigned fault = 0;          ///< of rtl_ref/faults.txt, 0: none
  std::string golden, output;  ///< of wave: its name and the file
  std::optional<bool> progress;
};

/// Adds the command and its actions to the command line.
void describe_traces(CLI::App& app, TracesArguments& arguments);

int traces(const TracesArguments& arguments);

}  // namespace dsdpv1::app
