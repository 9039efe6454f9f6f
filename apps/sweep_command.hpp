#pragma once
// sweep: a scenario over the product of some of its keys' values.
#include <optional>
#include <string>
#include <vector>

namespace app {

struct SweepArguments {
  std::string scenario;
  std::vector<std::string> parameters;  ///< PATH=VALUES
  std::vector<std::string> set;         ///< PATH=VALUE, at every point
  std::string checks;                   ///< of run; empty: what is usual there
  std::string map;                      ///< the check whose margin the pictures show; empty: the worst
  std::string out;                      ///< folder; empty: sweep_ and the scenario's name
  unsigned jobs = 0;                    ///< processes; 0: as many as there are processors
  std::optional<bool> progress;         ///< absent: on a terminal
  bool quiet = false;
};

int sweep(const SweepArguments& arguments);

}  // namespace app
