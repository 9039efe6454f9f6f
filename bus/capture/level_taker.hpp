#pragma once
// Levels of any number of signals of a recording, whatever the file's form is.
#include <cstddef>
#include <string>
#include <vector>

#include "bus/time.hpp"

namespace dsdpv1::bus::capture {

/// Who wants them.
class LevelTaker {
 public:
  virtual ~LevelTaker() = default;
  /// Called once, with the names of all signals (those of scopes before a dot): the places of those that are wanted.
  /// Throws CaptureError.
  virtual std::vector<std::size_t> choose(const std::vector<std::string>& names) = 0;
  /// The signal at place `which` of the chosen ones has this level from `at` on; in order of time. The same level
  /// again is allowed.
  virtual void level(Tick at, std::size_t which, bool level) = 0;
  /// The recording ends.
  virtual void finish(Tick end) = 0;
};

}  // namespace dsdpv1::bus::capture
