#pragma once
// Stimulus that no scenario has, and the moments of it at which a chip is saved: in the middle of what lasts a few
// ticks, and before what only a user, a host or a master out of order would do.
#include <functional>
#include <string>
#include <vector>

#include "tests/state/recorded.hpp"

namespace dsdpv1::state_test {

/// Between two inputs, which may be of one tick.
struct Moment {
  Tick at;
  std::size_t inputs;  ///< that have been
};

struct Aimed {
  Recorded stimulus;
  std::vector<Moment> moments;  ///< in order of time
};

/// All of them. Those with a seed in their name are random, and the same each time.
std::vector<Aimed> aimed();

/// Calls of a chip other than set(), before it is saved and from then on.
struct Act {
  std::string name;
  Config config;
  std::function<void(Chip&chip)> before, rest;
};
std::vector<Act> acts();

}  // namespace dsdpv1::state_test
