#pragma once
// calibrate: what a capture of a real chip's pins says of the rulings and their parameters.
#include <optional>
#include <string>
#include <vector>

namespace dsdpv1::app {

struct CalibrateArguments {
  std::string file;
  std::string scope, map;
  std::vector<std::string> signals;  ///< PIN=NAME, PIN=!NAME
  std::string rate;                  ///< "24 MHz"; empty: the file's, else found
  double jitter_ns = 5, clock_ppm = 1000;
  std::optional<int> station;
  std::string chip, json, table;
  bool all = false, quiet = false;
};

int calibrate(const CalibrateArguments& arguments);

}  // namespace dsdpv1::app
