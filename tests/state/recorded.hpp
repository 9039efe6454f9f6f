#pragma once
// Stimulus of which there is plenty: what the golden traces say that the pins of each slave of each scenario got.
#include <string>
#include <vector>

#include "model/dsdpv1/chip.hpp"

namespace dsdpv1::state_test {

struct Input {
  Tick at;
  Pin pin;
  Level level;

  bool operator==(const Input& other) const { return at == other.at && pin == other.pin && level == other.level; }
};

/// One slave of a scenario.
struct Recorded {
  std::string name;  ///< "two_slaves_io2"
  Config config;
  std::vector<Input> inputs;  ///< in order of time
  Tick end = 0;
};

/// Names of the scenarios that have a golden trace.
std::vector<std::string> recorded_scenarios();
/// All slaves of one of them.
std::vector<Recorded> recorded(const std::string& scenario);

}  // namespace dsdpv1::state_test
