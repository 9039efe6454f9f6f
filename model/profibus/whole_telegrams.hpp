#pragma once
// Telegrams that a bench passes to a chip, or gets from it, as runs of characters instead of edges: the same for every
// chip with a Station. Each function is the chip's of this name.
//
// `Chip`: `now`, `station`, advance(Tick), next_event(), evaluate(Tick event, Tick to), catch_up_line(Cycle),
// take_txd(): the output takes its level without a report, plan_station(): station.next() may have changed, and
// skips(): Engine::kSkip.
#include <algorithm>

#include "model/profibus/station.hpp"

namespace dsdpv1::profibus::whole_telegrams {

template <class Chip>
Cycle last_edge(const Chip& chip) {
  return chip.now / kTicksPerCycle;
}

template <class Chip>
bool hear(Chip& chip, Tick at, const CharacterRun& run) {
  chip.advance(at);
  chip.catch_up_line(last_edge(chip));
  if (!chip.skips() || !chip.station.set_run(run)) return false;
  chip.plan_station();
  return true;
}

template <class Chip>
void leave_run(Chip& chip, Tick at) {
  chip.advance(at);
  chip.catch_up_line(last_edge(chip));
  chip.station.leave_run(at);
  chip.station.forget_run();
  chip.plan_station();
}

template <class Chip>
void advance_in_run(Chip& chip, Tick to) {
  for (Tick event = chip.next_event(); event <= to; event = chip.next_event()) {
    chip.evaluate(event, to);
    if (chip.station.left_run()) return;
  }
  chip.now = std::max(chip.now, to);
}

template <class Chip>
Unconcerned unconcerned(const Chip& chip) {
  return chip.skips() ? chip.station.unconcerned() : Unconcerned{};
}

template <class Chip>
bool begins_to_send(const Chip& chip) {
  return chip.now % kTicksPerCycle == 0 && chip.station.begins_to_send(last_edge(chip));
}

template <class Chip>
CharacterRun hide_txd(Chip& chip) {
  const CharacterRun run = chip.station.hide_txd();
  chip.plan_station();
  return run;
}

template <class Chip>
void show_txd(Chip& chip, Tick at) {
  chip.advance(at);
  chip.station.show_txd(last_edge(chip));
  chip.take_txd();
  chip.plan_station();
}

}  // namespace dsdpv1::profibus::whole_telegrams
