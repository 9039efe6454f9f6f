#pragma once
// Receives the events of the blocks: one sink for the whole chip; without a listener one test for null.
#include "model/profibus/event.hpp"

namespace dsdpv1::profibus {

class EventLog {
 public:
  void attach(const EventSink& sink) { sink_ = sink; }

  /// At the rising edge of `cycle`.
  void at_cycle(Cycle cycle, Reason reason, unsigned a = 0, unsigned b = 0, unsigned c = 0) {
    at_tick(cycle * kTicksPerCycle, reason, a, b, c);
  }
  void at_tick(Tick tick, Reason reason, unsigned a = 0, unsigned b = 0, unsigned c = 0) {
    if (sink_.call == nullptr) return;
    sink_.call(sink_.self, Event{tick, reason, static_cast<std::uint16_t>(a), static_cast<std::uint16_t>(b),
                                 static_cast<std::uint16_t>(c)});
  }

 private:
  EventSink sink_;
};

}  // namespace dsdpv1::profibus
