#include "tb/report/html/pin_memory.hpp"

#include <algorithm>

namespace tb::html {
namespace {

bool turns(Turn turn, Level level) { return turn == Turn::kChange || (turn == Turn::kRise ? level == 1 : level == 0); }

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

bool PinMemory::is(const DiagramEdge& edge, PinNumber pin, Level level) const {
  return edge.pin == pin && turns(edge.turn, level) && (!edge.conditional || this->level(edge.where) == edge.level);
}

std::optional<Tick> PinMemory::last(const DiagramEdge& edge, Tick at) const {
  const std::deque<PinStep>& steps = pins_.at(edge.pin).steps;
  const auto found = std::find_if(steps.rbegin(), steps.rend(),
                                  [&](const PinStep& step) { return step.at <= at && turns(edge.turn, step.level); });
  if (found == steps.rend()) return std::nullopt;
  return found->at;
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

}  // namespace tb::html
