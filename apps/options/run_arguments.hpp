#pragma once
// The arguments of a scenario's run: by run, and by cosim and traces, which execute such runs.
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/options/common.hpp"
#include "apps/options/wave_options.hpp"

namespace dsdpv1::app {

struct RunArguments {
  std::string scenario, engine = "skip", view = "pins", checks;  ///< `checks` empty: as the scenario says
  WaveArguments wave;
  std::string log, result, trace, report, junit;  ///< files, empty: not wanted
  CaptureArguments capture;
  std::string golden;                                        ///< folder of golden traces, empty: not compared with them
  unsigned fault = 0;                                        ///< of rtl_ref/dsdpv1/faults.txt, 0: none
  std::string difference = "lockstep.vcd";                   ///< wave of a lockstep run's first difference
  std::optional<bool> progress;                              ///< absent: on a terminal
  std::vector<std::string> set;                              ///< PATH=VALUE: keys other than in the file
  std::optional<std::uint32_t> seed;                         ///< of RTL
  std::vector<std::pair<std::string, std::string>> save_at;  ///< time and file of each
  std::pair<std::string, std::string> rewind_on;             ///< code and time; empty: not wanted
  std::string restore;                                       ///< a saved run instead of a scenario, empty: none
  std::optional<int> gdb;                                    ///< TCP port for the debugger of the first ARM board
  tb::CheckRows check_rows = tb::CheckRows::kViolated;       ///< of the summary
  bool log_whole = false, quiet = false;
};

}  // namespace dsdpv1::app
