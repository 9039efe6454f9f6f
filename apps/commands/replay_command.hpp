#pragma once
// The options of `replay` as values.
#include <optional>
#include <string>

#include "apps/options/wave_options.hpp"

namespace dsdpv1::app {

struct ReplayArguments {
  std::string capture;
  int slave = -1;  ///< address
  std::string gsd, scenario;
  std::string inputs;               ///< recorded or scenario; empty: recorded without a scenario
  std::string baud, signal;         ///< as of decode
  std::string from, to;             ///< times of the capture; empty: all of it
  std::optional<double> tolerance;  ///< of the TSDR, bit times
  std::string engine = "skip";
  std::string json, table, log, result;
  std::string checks;  ///< as of RunArguments
  std::string capture_out, capture_link = "profibus";
  WaveArguments wave;
  std::optional<bool> progress;  ///< absent: on a terminal
  bool inverted = false, no_lead_in = false, log_whole = false, quiet = false;
};

/// 0 equal, 1 different, 2 wrong input, 130 interrupted.
int replay(const ReplayArguments& arguments);

}  // namespace dsdpv1::app
