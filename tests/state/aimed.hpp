#pragma once
// Stimuli that no scenario has, and the moments at which a chip is saved: during actions of a few ticks, and before
// actions of a faulty user, host or master.
#include <functional>
#include <string>
#include <vector>

#include "tests/state/recorded.hpp"

namespace dsdpv1::state_test {

/// A moment between two inputs, which may be at the same tick.
struct Moment {
  Tick at;
  std::size_t inputs;  ///< number of inputs before it
};

struct Aimed {
  Recorded stimulus;
  std::vector<Moment> moments;  ///< in order of time
};

/// All stimuli. Those with a seed in their name are random, and the same each time.
std::vector<Aimed> aimed();

/// Calls other than set() on a chip, before it is saved and after.
struct Act {
  std::string name;
  Config config;
  std::function<void(Chip&chip)> before, rest;
};
std::vector<Act> acts();

}  // namespace dsdpv1::state_test
