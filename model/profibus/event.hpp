#pragma once
// Events of the chip: every refusal with its reason (ruling S8), every state change, every violated rule of the user's
// bus. Events carry only a reason and numbers; `describe` makes the text, outside the core's per-character path.
#include <cstdint>
#include <string>

#include "model/profibus/reason.hpp"
#include "model/profibus/time.hpp"
#include "model/profibus/words.hpp"

namespace dsdpv1::profibus {

struct Event {
  Tick at = 0;
  Reason reason{};
  std::uint16_t a = 0, b = 0, c = 0;  ///< values for {a}, {b}, {c} in the text
};

/// Receives events in order of time (host port violations carry the tick, all others the tick of a cycle's rising
/// edge).
struct EventSink {
  void (*call)(void* self, const Event& event) = nullptr;
  void* self = nullptr;
};

/// The event as text, one line, without the time.
std::string describe(const Event& event, const Words& words);
/// The text of a reason with the chip's words, {a}, {b} and {c} left as placeholders, and its advice.
std::string text_template(Reason reason, const Words& words);
std::string advice(Reason reason, const Words& words);

}  // namespace dsdpv1::profibus
