#pragma once
// Plentiful stimulus: the inputs of each slave of each scenario, from the golden traces.
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

/// Names of the scenarios that have a golden trace, and one chip of this model for all slaves.
std::vector<std::string> recorded_scenarios();
/// All slaves of a scenario.
std::vector<Recorded> recorded(const std::string& scenario);

}  // namespace dsdpv1::state_test
