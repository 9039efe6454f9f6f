#pragma once
// The order in which the parties of a bench act: masters, chips, user CPUs and scripts are agents; the timeline lets
// them act in order of time, and at equal times in the order in which they were added (chips first, so that an output
// of cycle n is seen by everybody who looks at the tick of cycle n).
//
// Nobody is polled: the timeline knows when each agent wants to act, and an agent whose plan changes announces it. In
// one step everybody due at that tick has one turn, in order, as its plan is when its turn comes: who becomes due
// through an earlier one acts in the same step, who becomes due through a later one in the next step at the same tick.
#include <cstddef>
#include <vector>

#include "bus/plan_queue.hpp"
#include "bus/time.hpp"

namespace dsdpv1::bus {

class Timeline;

/// Somebody who acts at points of simulated time. It may end before its timeline and after it.
class Agent {
 public:
  Agent() = default;
  virtual ~Agent();
  Agent(const Agent&) = delete;
  Agent& operator=(const Agent&) = delete;

  /// The tick of the next action, `kNever` when nothing is planned. May move earlier when others act on the agent.
  virtual Tick next() const = 0;
  /// Acts at `now`, which is never before `next()` and never less than at an earlier call.
  virtual void run(Tick now) = 0;

 protected:
  /// `next()` may have become another: to be called by everything but `run` that changes what it depends on. Before or
  /// after the change: the timeline does not ask at once, but when the agent that acts has had its turn. Costs little,
  /// and nothing outside of a timeline.
  void announce();
  /// The same by one who knows: `next()` is `plan` now.
  void announce(Tick plan);

 private:
  friend class Timeline;
  Timeline* timeline_ = nullptr;
  std::size_t place_ = 0;
};

class Timeline {
 public:
  Timeline();
  ~Timeline();
  Timeline(const Timeline&) = delete;
  Timeline& operator=(const Timeline&) = delete;

  /// An agent has one timeline (std::logic_error).
  void add(Agent& agent);

  /// The tick of the earliest planned action of any agent.
  Tick next();
  /// The tick of the first turn of anybody but `agent`, which has its turn, at most the one after the limit of the
  /// step: as long as it does nothing to others, nothing happens before that.
  Tick quiet_until(const Agent& agent);
  /// It is quiet up to and including `tick`, where `agent` would act next: the step goes on to that tick, and this is
  /// its turn there. False: it has to wait for it.
  bool go_on(const Agent& agent, Tick tick);
  /// Runs every action due up to and including `until`; `now()` is then `until`.
  void run_until(Tick until);
  /// Runs the actions of one tick, the earliest, if it is not after `limit`. False when there is none.
  bool step(Tick limit);
  Tick now() const { return now_; }

  /// Each step asks every agent, and throws std::logic_error when one plans something else than it has announced: that
  /// would be a silent fault. Always so in a debug build.
  void check_announcements() { checks_ = true; }

 private:
  friend class Agent;
  struct Entry {
    Agent* agent;
    bool has_news;
  };
  void announced(std::size_t place);
  void hear_news(const Agent* except = nullptr);
  std::size_t next_turn(std::size_t from);
  bool has_news_of_others(std::size_t place) const;
  void leave(std::size_t place);
  void compare(std::size_t place) const;

  std::vector<Entry> agents_;  ///< null: it has ended
  PlanQueue plans_;
  std::vector<std::size_t> news_;  ///< who has announced something that was not asked for yet
  Tick now_ = 0;
  Tick limit_ = kNever;  ///< of the step under way
  // What `quiet_until` has found out stands until somebody else's plan is another.
  std::size_t asked_by_ = PlanQueue::kNone;
  Tick others_at_ = kNever;  ///< when all but that place have their next turn
  bool checks_ = false;
};

inline void Timeline::announced(std::size_t place) {
  Entry& entry = agents_[place];
  if (entry.has_news) return;
  entry.has_news = true;
  news_.push_back(place);
}

inline void Agent::announce() {
  if (timeline_ != nullptr) timeline_->announced(place_);
}

inline void Agent::announce(Tick plan) {
  if (timeline_ != nullptr && timeline_->plans_.at(place_) != plan) timeline_->announced(place_);
}

}  // namespace dsdpv1::bus
