#include "bus/timeline.hpp"

#include <algorithm>

namespace bus {

Tick Timeline::next() const {
  Tick earliest = kNever;
  for (const Agent* agent : agents_) earliest = std::min(earliest, agent->next());
  return earliest;
}

Tick Timeline::next_except(const Agent& agent) const {
  Tick earliest = kNever;
  for (const Agent* each : agents_)
    if (each != &agent) earliest = std::min(earliest, each->next());
  return earliest;
}

bool Timeline::step(Tick limit) {
  const Tick due = next();
  if (due == kNever || due > limit) return false;
  now_ = std::max(now_, due);
  for (Agent* agent : agents_)
    if (agent->next() <= now_) agent->run(now_);
  return true;
}

void Timeline::run_until(Tick until) {
  while (step(until)) {
  }
  now_ = std::max(now_, until);
}

}  // namespace bus
