#include "tb/report/html/pin_memory.hpp"

#include <algorithm>

namespace dsdpv1::tb::html {
namespace {

bool turns(Turn turn, Level level) {
  switch (turn) {
    case Turn::kRise: return level == 1;
    case Turn::kFall: return level == 0;
    case Turn::kValue: return level >= 0;
    case Turn::kChange: break;
  }
  return true;
}

}  // namespace

void PinMemory::add(Tick at, PinNumber pin, Level level) {
  Pin& own = pins_.at(pin);
  own.steps.push_back({at, level});
  if (own.steps.size() <= kDepth) return;
  own.before = own.steps.front().level;
  own.steps.pop_front();
}

Level PinMemory::level(PinNumber pin) const {
  const Pin& own = pins_.at(pin);
  return own.steps.empty() ? own.before : own.steps.back().level;
}

bool PinMemory::is(const DiagramEdge& edge, Tick at, PinNumber pin, Level level) const {
  return edge.pin == pin && turns(edge.turn, level) && holds(edge, at);
}

bool PinMemory::holds(const DiagramEdge& edge, Tick at) const {
  return std::all_of(
      edge.where.begin(), edge.where.begin() + static_cast<std::ptrdiff_t>(edge.conditions),
      [&](const PinLevel& wanted) { return had(wanted, at); });
}

/// Just before `at` or at it: changes of one tick arrive in any order.
bool PinMemory::had(const PinLevel& wanted, Tick at) const {
  const Pin& own = pins_.at(wanted.pin);
  auto step = std::upper_bound(own.steps.begin(), own.steps.end(), at,
                               [](Tick time, const PinStep& each) { return time < each.at; });
  while (step != own.steps.begin()) {
    --step;
    if (step->level == wanted.level) return true;
    if (step->at < at) return false;
  }
  return own.before == wanted.level;
}

std::optional<Tick> PinMemory::last(const DiagramEdge& edge, Tick at) const {
  const std::deque<PinStep>& steps = pins_.at(edge.pin).steps;
  const std::size_t looked = edge.conditions == 0 ? steps.size() : std::min(kLooked, steps.size());
  const auto end = steps.rbegin() + static_cast<std::ptrdiff_t>(looked);
  const auto found = std::find_if(steps.rbegin(), end, [&](const PinStep& step) {
    return step.at <= at && turns(edge.turn, step.level) && holds(edge, step.at);
  });
  if (found == end) return std::nullopt;
  return found->at;
}

std::optional<Tick> PinMemory::first(const DiagramEdge& edge, Tick from, Tick to) const {
  std::optional<Tick> found;
  const std::deque<PinStep>& steps = pins_.at(edge.pin).steps;
  for (auto step = steps.rbegin(); step != steps.rend() && step->at >= from; ++step)
    if (step->at <= to && turns(edge.turn, step->level) && holds(edge, step->at)) found = step->at;
  return found;
}

PinTrace PinMemory::trace(PinNumber pin, Tick from, Tick to) const {
  const Pin& own = pins_.at(pin);
  PinTrace trace{pin, own.before, {}};
  for (const PinStep& step : own.steps) {
    if (step.at > to) break;
    if (step.at <= from)
      trace.first = step.level;
    else
      trace.steps.push_back(step);
  }
  return trace;
}

}  // namespace dsdpv1::tb::html
