#include "bus/plan_queue.hpp"

#include <algorithm>
#include <utility>

namespace bus {

Tick PlanQueue::smallest(const Tick* group) {
  Tick earliest = group[0];
  for (std::size_t i = 1; i < kWidth; ++i) earliest = std::min(earliest, group[i]);
  return earliest;
}

std::size_t PlanQueue::add() {
  if (size_ == rows_[0].size()) grow();
  return size_++;
}

/// One group more in the lowest row, and what that needs above.
void PlanQueue::grow() {
  for (std::size_t row = 0;; ++row) {
    rows_[row].resize(rows_[row].size() + kWidth, kNever);
    if (row + 1 == rows_.size()) rows_.emplace_back(kWidth, kNever);
    std::vector<Tick>& above = rows_[row + 1];
    const std::size_t groups = rows_[row].size() / kWidth;
    for (std::size_t i = 0; i < std::min(groups, above.size()); ++i) above[i] = smallest(&rows_[row][i * kWidth]);
    if (groups <= above.size()) return;
  }
}

void PlanQueue::set(std::size_t place, Tick at) {
  Tick before = std::exchange(rows_[0][place], at);
  for (std::size_t row = 1; row < rows_.size(); ++row) {
    place /= kWidth;
    Tick& earliest = rows_[row][place];
    if (at > earliest) {
      if (before != earliest) return;  // neither was nor is the smallest of its group
      at = smallest(&rows_[row - 1][place * kWidth]);
    }
    before = std::exchange(earliest, at);
  }
}

Tick PlanQueue::earliest_other(std::size_t place, Tick at) const {
  Tick earliest = kNever;
  for (const std::vector<Tick>& row : rows_) {
    const std::size_t first = place / kWidth * kWidth;
    for (std::size_t i = first; i < first + kWidth; ++i)
      if (i != place) earliest = std::min(earliest, row[i]);
    if (earliest <= at) return earliest;
    place /= kWidth;
  }
  return earliest;
}

std::size_t PlanQueue::first_due(std::size_t from, Tick now) const {
  std::size_t row = 0, i = from;
  for (;;) {  // up and to the right until somebody below is due
    const std::size_t end = std::min((i + kWidth) / kWidth * kWidth, rows_[row].size());
    while (i < end && rows_[row][i] > now) ++i;
    if (i < end) break;
    if (++row == rows_.size()) return kNone;
    i = (i + kWidth - 1) / kWidth;
  }
  for (; row > 0; --row)  // down to the first of them
    for (i *= kWidth; rows_[row - 1][i] > now;) ++i;
  return i;
}

}  // namespace bus
