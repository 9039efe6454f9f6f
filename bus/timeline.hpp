#pragma once
// The order of actions in a bench: masters, chips, user CPUs and scripts are agents. The timeline runs them in order of
// time, and at equal times in the order of addition (chips first, so that an output of cycle n is visible to every
// agent at the tick of cycle n).
//
// Agents are not polled: the timeline knows when each one acts next, and an agent whose plan changes announces it. In
// one step every agent due at that tick has one turn, in order, according to its plan at that time. An agent made due
// by an earlier one acts in the same step, one made due by a later one in the next step at the same tick.
#include <cstddef>
#include <vector>

#include "bus/plan_queue.hpp"
#include "bus/time.hpp"

namespace dsdpv1::bus {

class Timeline;

/// A participant that acts at points in simulated time. It may be destroyed before or after its timeline.
class Agent {
 public:
  Agent() = default;
  virtual ~Agent();
  Agent(const Agent&) = delete;
  Agent& operator=(const Agent&) = delete;

  /// The tick of the next action, `kNever` without a plan. May become earlier when others act on the agent.
  virtual Tick next() const = 0;
  /// Acts at `now`, which is never before `next()` or an earlier call's.
  virtual void run(Tick now) = 0;

 protected:
  /// Call this before or after any change, except in run(), that may alter next(): the timeline queries it after the
  /// present agent's turn. Cheap, and without effect outside a timeline.
  void announce();
  /// As announce(), if the caller knows the new value of next().
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

  /// Throws std::logic_error if the agent already belongs to a timeline.
  void add(Agent& agent);

  /// The tick of the earliest planned action of any agent.
  Tick next();
  /// The tick of the first turn of any other agent while `agent` has its turn, at most one after the limit of the step:
  /// nothing happens before it unless `agent` acts on others.
  Tick quiet_until(const Agent& agent);
  /// Extends the present turn of `agent` to `tick`, where it would act next, if no other agent is due up to and
  /// including `tick`. Returns false if it has to wait for its turn.
  bool go_on(const Agent& agent, Tick tick);
  /// Runs every action due up to and including `until`; `now()` is then `until`.
  void run_until(Tick until);
  /// Runs the actions of one tick, the earliest, if it is not after `limit`. Returns false without one.
  bool step(Tick limit);
  Tick now() const { return now_; }

  /// Each step queries every agent and throws std::logic_error if a plan differs from the announced one: that would be
  /// a silent fault. Always on in a debug build.
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
  void ask_others(const Agent& agent);
  void leave(std::size_t place);
  void compare(std::size_t place) const;
  void compare_others(std::size_t place) const;

  std::vector<Entry> agents_;  ///< null: destroyed
  PlanQueue plans_;
  std::vector<std::size_t> news_;  ///< agents whose announcement has not been queried yet
  Tick now_ = 0;
  Tick limit_ = kNever;  ///< of the present step
  // The result of `quiet_until`, valid until another agent's plan changes.
  std::size_t asked_by_ = PlanQueue::kNone;
  Tick others_at_ = kNever;  ///< the next turn of all other places
  bool checks_ = false;
};

inline void Timeline::announced(std::size_t place) {
  Entry& entry = agents_[place];
  if (entry.has_news) return;
  entry.has_news = true;
  news_.push_back(place);
}

inline bool Timeline::has_news_of_others(std::size_t place) const {
  return !news_.empty() && (news_.size() > 1 || news_.front() != place);
}

inline Tick Timeline::quiet_until(const Agent& agent) {
  if (asked_by_ != agent.place_ || has_news_of_others(agent.place_)) ask_others(agent);
  return limit_ < others_at_ ? limit_ + 1 : others_at_;
}

inline bool Timeline::go_on(const Agent& agent, Tick tick) {
  if (quiet_until(agent) <= tick) return false;
  if (checks_) compare_others(agent.place_);
  now_ = now_ < tick ? tick : now_;
  return true;
}

inline void Agent::announce() {
  if (timeline_ != nullptr) timeline_->announced(place_);
}

inline void Agent::announce(Tick plan) {
  if (timeline_ != nullptr && timeline_->plans_.at(place_) != plan) timeline_->announced(place_);
}

}  // namespace dsdpv1::bus
