#include "bus/plan_queue.hpp"

#include <algorithm>

namespace bus {

std::size_t PlanQueue::add() {
  const std::size_t place = size_++;
  if (size_ == leaves_) grow();
  return place;
}

void PlanQueue::grow() {
  const std::vector<Tick> before = std::move(nodes_);
  const std::size_t leaves = leaves_;
  leaves_ *= 2;
  nodes_.assign(2 * leaves_, kNever);
  for (std::size_t place = 0; place < leaves; ++place) set(place, before[leaves + place]);
}

void PlanQueue::set(std::size_t place, Tick at) {
  std::size_t node = leaves_ + place;
  nodes_[node] = at;
  while ((node /= 2) != 0) {
    const Tick earliest = std::min(nodes_[2 * node], nodes_[2 * node + 1]);
    if (nodes_[node] == earliest) return;
    nodes_[node] = earliest;
  }
}

Tick PlanQueue::earliest_except(std::size_t place) const {
  Tick earliest = kNever;
  for (std::size_t node = leaves_ + place; node > 1; node /= 2) earliest = std::min(earliest, nodes_[node ^ 1U]);
  return earliest;
}

std::size_t PlanQueue::first_due(std::size_t from, Tick now) const {
  std::size_t node = leaves_ + from;
  while (nodes_[node] > now) {
    while (node % 2 != 0) node /= 2;  // the right child: what follows it follows its parent
    if (node == 0) return kNone;
    ++node;
  }
  while (node < leaves_) {
    node *= 2;
    if (nodes_[node] > now) ++node;
  }
  return node - leaves_;
}

}  // namespace bus
