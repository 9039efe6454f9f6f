#pragma once
// Keeps the events of a block under test.
#include <vector>

#include "model/profibus/event_log.hpp"

namespace dsdpv1::core_test {

struct EventRecorder {
  EventRecorder() { log.attach({&take, this}); }
  EventRecorder(const EventRecorder&) = delete;
  EventRecorder& operator=(const EventRecorder&) = delete;

  int count(profibus::Reason reason) const {
    int found = 0;
    for (const profibus::Event& event : events) found += event.reason == reason ? 1 : 0;
    return found;
  }

  std::vector<profibus::Event> events;
  profibus::EventLog log;

 private:
  static void take(void* self, const profibus::Event& event) {
    static_cast<EventRecorder*>(self)->events.push_back(event);
  }
};

inline bool same(const profibus::Event& a, const profibus::Event& b) {
  return a.at == b.at && a.reason == b.reason && a.a == b.a && a.b == b.b && a.c == b.c;
}

}  // namespace dsdpv1::core_test
