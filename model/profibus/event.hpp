#pragma once
// What the chip has to say about itself: every refusal with its reason (ruling S8), every state change, every violated
// rule of the user's bus. Events carry numbers only; words are made outside the core's per-character path, by
// `describe`.
#include <cstddef>
#include <cstdint>
#include <string>

#include "model/profibus/time.hpp"

namespace profibus {

/// What kind of event: decides how it is counted and shown.
enum class Severity : std::uint8_t {
  kInfo,       ///< a state change or a service that was carried out
  kRefusal,    ///< the chip refused something that a master or the user asked for
  kViolation,  ///< the user's side broke a rule of the host port or the handshake
};

// X(identifier, severity, stable code, text, advice). The text may hold {a}, {b}, {c} (decimal), {a:4x} (hexadecimal, 4
// digits), {a:state} (a DP state), {a:rate} (a baud rate), {a:sap} (a SAP or none), {a:rm} (a row of
// the RM registry), {a:high} and {a:low} (its bytes), {a:low2x}.
// The table is in event_table.inc; docs/reasons.md explains each and is generated from it.
enum class Reason : std::uint8_t {
#define X(id, severity, code, text, advice) id,
#include "model/profibus/event_table.inc"
#undef X
};

struct Event {
  Tick at = 0;
  Reason reason{};
  std::uint16_t a = 0, b = 0, c = 0;  ///< what the text's {a}, {b}, {c} stand for
};

/// Receives events in order of time (host port violations carry the tick, all others the tick of a cycle's rising
/// edge).
struct EventSink {
  void (*call)(void* self, const Event& event) = nullptr;
  void* self = nullptr;
};

/// The stable code of a reason ("PRM_IDENT"), for logs and result files.
const char* code(Reason reason);
Severity severity(Reason reason);
/// The text of a reason with its placeholders, what to do about it, and how many reasons there are: for documentation.
const char* text_template(Reason reason);
const char* advice(Reason reason);
std::size_t reason_count();
/// The event in words, one line, without the time.
std::string describe(const Event& event);

}  // namespace profibus
