#include "bus/plan_queue.hpp"

#include <algorithm>
#include <utility>

namespace dsdpv1::bus {

std::size_t PlanQueue::add() {
  if (size_ == leaves_) build(2 * leaves_);
  return size_++;
}

void PlanQueue::build(std::size_t leaves) {
  leaves_ = leaves;
  plans_.resize(leaves, kNever);
  winners_.assign(2 * leaves, 0);
  for (std::size_t place = 0; place < leaves; ++place) winners_[leaves + place] = static_cast<Place>(place);
  for (std::size_t node = leaves - 1; node > 0; --node) winners_[node] = better(node);
}

// A node whose winner is another place with an unchanged plan does not change.
void PlanQueue::set(std::size_t place, Tick at) {
  if (std::exchange(plans_[place], at) == at) return;
  for (std::size_t node = (leaves_ + place) / 2; node > 0; node /= 2) {
    const Place winner = better(node);
    if (std::exchange(winners_[node], winner) == winner && winner != place) return;
  }
}

Tick PlanQueue::earliest_other(std::size_t place) const {
  if (winners_[1] != place) return earliest();
  Tick earliest = kNever;
  for (std::size_t node = leaves_ + place; node > 1; node /= 2) earliest = std::min(earliest, plan_of(node ^ 1U));
  return earliest;
}

std::size_t PlanQueue::first_due(std::size_t from, Tick now) const {
  if (plan_of(1) > now || from >= size_) return kNone;
  if (from == 0) return first_due_below(1, now);
  std::size_t node = leaves_ + from;
  for (; plan_of(node) > now; ++node) {  // the next to the right, using the greatest node that begins there
    while (node % 2 == 1) node /= 2;
    if (node == 0) return kNone;
  }
  return first_due_below(node, now);
}

std::size_t PlanQueue::first_due_below(std::size_t node, Tick now) const {
  while (node < leaves_) {
    node *= 2;
    if (plan_of(node) > now) ++node;
  }
  return node - leaves_;
}

}  // namespace dsdpv1::bus
