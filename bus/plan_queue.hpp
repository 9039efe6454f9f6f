#pragma once
// The next action times of several agents, as a tournament: each inner node holds the earlier of its two children, so a
// change and a search for the earliest or the next in order have logarithmic cost. Agents are places 0, 1, ... in the
// order of addition, which is also the order at equal ticks.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bus/time.hpp"

namespace dsdpv1::bus {

/// Allocates in `add` only.
class PlanQueue {
 public:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  PlanQueue() { build(1); }

  /// Adds a last place without a plan.
  std::size_t add();
  void set(std::size_t place, Tick at);
  Tick at(std::size_t place) const { return plans_[place]; }

  /// The earliest plan, kNever without one.
  Tick earliest() const { return plan_of(1); }
  /// The earliest plan of all places except `place`, kNever without one.
  Tick earliest_other(std::size_t place) const;
  /// The first place from `from` on (at most one after the last) that is due at `now` or before; else kNone.
  std::size_t first_due(std::size_t from, Tick now) const;

 private:
  using Place = std::uint32_t;

  void build(std::size_t leaves);
  Tick plan_of(std::size_t node) const { return plans_[winners_[node]]; }
  Place better(std::size_t node) const {
    const Place left = winners_[2 * node], right = winners_[2 * node + 1];
    return plans_[right] < plans_[left] ? right : left;
  }
  std::size_t first_due_below(std::size_t node, Tick now) const;

  std::size_t size_ = 0, leaves_ = 0;
  std::vector<Tick> plans_;     ///< of places; filled up to a power of two with kNever
  std::vector<Place> winners_;  ///< node 1 is the root, 2 n and 2 n + 1 are below n; leaf leaves_ + p is place p
};

}  // namespace dsdpv1::bus
