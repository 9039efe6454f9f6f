#pragma once
// Receives levels of any number of signals from a recording of any format.
#include <cstddef>
#include <string>
#include <vector>

#include "bus/time.hpp"

namespace dsdpv1::bus::capture {

/// The receiver of the levels.
class LevelTaker {
 public:
  virtual ~LevelTaker() = default;
  /// Called once, with the names of all signals (those of scopes before a dot): returns the indexes of the wanted ones.
  /// Throws CaptureError.
  virtual std::vector<std::size_t> choose(const std::vector<std::string>& names) = 0;
  /// The signal at index `which` of the chosen ones has this level from `at` on; in order of time. The same level again
  /// is allowed.
  virtual void level(Tick at, std::size_t which, bool level) = 0;
  /// The recording ends.
  virtual void finish(Tick end) = 0;
};

}  // namespace dsdpv1::bus::capture
