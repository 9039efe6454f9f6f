#include "bus/timeline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <typeinfo>

namespace dsdpv1::bus {
namespace {

#ifdef NDEBUG
constexpr bool kDebugBuild = false;
#else
constexpr bool kDebugBuild = true;
#endif

}  // namespace

Agent::~Agent() {
  if (timeline_ != nullptr) timeline_->leave(place_);
}

Timeline::Timeline() : checks_(kDebugBuild) {}

Timeline::~Timeline() {
  for (const Entry& entry : agents_)
    if (entry.agent != nullptr) entry.agent->timeline_ = nullptr;
}

void Timeline::add(Agent& agent) {
  if (agent.timeline_ != nullptr) throw std::logic_error("an agent is added to a timeline twice");
  agent.timeline_ = this;
  agent.place_ = plans_.add();
  agents_.push_back({&agent, false});
  news_.reserve(agents_.size());
  announced(agent.place_);
}

void Timeline::leave(std::size_t place) {
  agents_[place].agent = nullptr;
  plans_.set(place, kNever);
  asked_by_ = PlanQueue::kNone;
}

/// Queries the agents that have announced a change, except `except`, which is in the middle of its turn.
void Timeline::hear_news(const Agent* except) {
  std::size_t kept = 0;
  for (const std::size_t place : news_) {
    Entry& entry = agents_[place];
    if (entry.agent != nullptr && entry.agent == except) {
      news_[kept++] = place;
      continue;
    }
    entry.has_news = false;
    if (entry.agent == nullptr) continue;
    const Tick plan = entry.agent->next();
    if (plan != plans_.at(place) && place != asked_by_) asked_by_ = PlanQueue::kNone;
    plans_.set(place, plan);
  }
  news_.resize(kept);
}

Tick Timeline::next() {
  hear_news();
  return plans_.earliest();
}

void Timeline::ask_others(const Agent& agent) {
  hear_news(&agent);
  others_at_ = plans_.earliest_other(agent.place_);
  asked_by_ = agent.place_;
}

bool Timeline::step(Tick limit) {
  const Tick due = next();
  if (checks_)
    for (std::size_t place = 0; place < agents_.size(); ++place) compare(place);
  if (due == kNever || due > limit) return false;
  limit_ = limit;
  now_ = std::max(now_, due);
  for (std::size_t place = next_turn(0); place != PlanQueue::kNone; place = next_turn(place + 1)) {
    announced(place);
    agents_[place].agent->run(now_);
  }
  return true;
}

std::size_t Timeline::next_turn(std::size_t from) {
  hear_news();
  const std::size_t place = plans_.first_due(from, now_);
  if (checks_ && place != PlanQueue::kNone) compare(place);
  return place;
}

void Timeline::compare(std::size_t place) const {
  const Agent* agent = agents_[place].agent;
  if (agent == nullptr || agent->next() == plans_.at(place)) return;
  throw std::logic_error(fmt::format("at tick {} agent {} ({}) plans tick {}, but has announced {}", now_, place,
                                     typeid(*agent).name(), agent->next(), plans_.at(place)));
}

void Timeline::compare_others(std::size_t place) const {
  for (std::size_t each = 0; each < agents_.size(); ++each)
    if (each != place) compare(each);
}

void Timeline::run_until(Tick until) {
  while (step(until)) {
  }
  now_ = std::max(now_, until);
}

}  // namespace dsdpv1::bus
