#pragma once
// Where a run leaves its golden, and two traces compared at rest.
#include <optional>
#include <string>

#include "lab/traces/trace.hpp"

namespace dsdpv1::tb::traces {

/// What one side does with a signal at the tick of the difference.
struct Side {
  Level level = kLevelX;  ///< that it has then
  bool changed = false;   ///< to it, at this tick
};

struct Difference {
  Tick at = 0;
  Signal signal;
  Side golden, here;
};

/// "pin READY of io: golden 0, here still 1", "the line: golden still 1, here 0".
std::string what_differs(const Difference& difference);

}  // namespace dsdpv1::tb::traces
