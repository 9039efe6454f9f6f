#pragma once
// When each of several parties wants to act next, as a tournament: each inner node holds the smallest of its eight
// children, so a change, the earliest of all and the next in order cost the logarithm of their number; up to eight are
// one look at a row. The parties are places 0, 1, ...: the order in which they were added.
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
  Tick at(std::size_t place) const { return rows_[0][place]; }

  /// The earliest of all, kNever when nothing is planned.
  Tick earliest() const { return smallest(&rows_.back()[0]); }
  /// The earliest of all but `place`, kNever when they plan nothing; or any of them that is due at `at` or before, where
  /// somebody is.
  Tick earliest_other(std::size_t place, Tick at) const;
  /// The first place from `from` on, at most one after the last, that is due at `now` or before; else kNone.
  std::size_t first_due(std::size_t from, Tick now) const;

 private:
  static constexpr std::size_t kWidth = 8;
  static Tick smallest(const Tick* group);
  void grow();

  // rows_[0] are the places; element i of a higher row is the smallest of elements 8 i to 8 i + 7 of the row below. The
  // highest row is one group. Rows are filled up with kNever.
  std::size_t size_ = 0;
  std::vector<std::vector<Tick>> rows_ = {std::vector<Tick>(kWidth, kNever)};
};

}  // namespace bus
