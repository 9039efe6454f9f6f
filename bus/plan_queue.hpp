#pragma once
// When each of several parties wants to act next, as a tournament: each inner node holds the smaller of its two
// children, so a change, the earliest of all and the next in order cost the logarithm of their number. The parties are
// places 0, 1, ...: the order in which they were added.
#include <cstddef>
#include <vector>

#include "bus/time.hpp"

namespace bus {

/// Needs memory in `add` only.
class PlanQueue {
 public:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  /// The new last place, which plans nothing yet.
  std::size_t add();
  void set(std::size_t place, Tick at);
  Tick at(std::size_t place) const { return nodes_[leaves_ + place]; }

  /// The earliest of all, kNever when nothing is planned.
  Tick earliest() const { return nodes_[1]; }
  Tick earliest_except(std::size_t place) const;
  /// The first place from `from` on, at most one after the last, that is due at `now` or before; else kNone.
  std::size_t first_due(std::size_t from, Tick now) const;

 private:
  void grow();

  // nodes_[1] is the root, the children of i are 2 i and 2 i + 1. There is always a leaf without a place.
  std::size_t size_ = 0, leaves_ = 1;
  std::vector<Tick> nodes_ = {kNever, kNever};
};

}  // namespace bus
