#pragma once
// The order in which the parties of a bench act: masters, chips, user CPUs and scripts are agents; the timeline lets
// them act in order of time, and at equal times in the order in which they were added (chips first, so that an output
// of cycle n is seen by everybody who looks at the tick of cycle n).
#include <vector>

#include "bus/time.hpp"

namespace bus {

/// Somebody who acts at points of simulated time.
class Agent {
 public:
  virtual ~Agent() = default;
  /// The tick of the next action, `kNever` when nothing is planned. May move earlier when others act on the agent.
  virtual Tick next() const = 0;
  /// Acts at `now`, which is never before `next()` and never less than at an earlier call.
  virtual void run(Tick now) = 0;
};

class Timeline {
 public:
  void add(Agent& agent) { agents_.push_back(&agent); }

  /// The tick of the earliest planned action of any agent.
  Tick next() const;
  /// The same of everybody but `agent`: as long as it does nothing to others, nothing happens before that tick.
  Tick next_except(const Agent& agent) const;
  /// Runs every action due up to and including `until`; `now()` is then `until`.
  void run_until(Tick until);
  /// Runs the actions of one tick, the earliest, if it is not after `limit`. False when there is none.
  bool step(Tick limit);
  Tick now() const { return now_; }

 private:
  std::vector<Agent*> agents_;
  Tick now_ = 0;
};

}  // namespace bus
