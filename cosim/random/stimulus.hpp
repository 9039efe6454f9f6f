#pragma once
// Stimulus for lockstep runs without the bench: what happens at the chip's input pins, as short lines of text.
//
// Three lanes act at the same time: the bus (send, spike), the user at the host port (pin, and what the kind of chip
// has, RandomCases), the board (reset). Each action begins `delay` ticks after the one before it in its lane has ended;
// `sync` lets all lanes wait for each other. An action of user or board may be aimed: it waits for a part of an access
// of the chip, and `delay` counts from its begin.
#include <string>
#include <vector>

#include "bus/wire/uart.hpp"
#include "cosim/rtl.hpp"

namespace dsdpv1::cosim {

enum class Verb : std::uint8_t {
  kSend,   ///< a telegram at `rate`; then an answer is waited for, `reply_bits` bit times for its beginning
  kSpike,  ///< the line low for `low` ticks, whoever drives it
  kReset,  ///< RESET low for `low` ticks, then high
  kSync,
  kPin,   ///< one input pin to `value`: the first one of the user's
  kHost,  ///< the kind's own verbs have this value and those behind it
};
constexpr Verb kLastVerb{0xFF};
constexpr Verb host_verb(int number) { return static_cast<Verb>(static_cast<int>(Verb::kHost) + number); }

/// One action; members that its verb does not name are not used.
struct Action {
  Verb verb = Verb::kSync;
  Tick delay = 0;
  Tick rate = 0, reply_bits = 0, address = 0, crc_address = 0, value = 0, bits = 0, ppm = 0;
  Tick setup = 200, low = 600, hold = 200, high = 600, lead = 600, lag = 600, pause = 0;
  const char* during = nullptr;  ///< aimed at: of Vocabulary::access_parts
  Tick within = 0;               ///< ... but so long is waited for it at most
  PinNumber pin = 0;
  bus::Bytes bytes = {};
  bus::WireFaults faults = {};
};

using Stimulus = std::vector<Action>;

/// The text of a stimulus file for a chip of this kind: comments, one action a line.
std::string to_text(const Stimulus& stimulus, const tb::ChipKind& kind);
/// Reads it; lines between `repeat COUNT` (1 to 1000) and `end` count COUNT times, at most a million in all. `file` is
/// for messages only. Throws tb::InputError, also for actions and pins that the chip has not. Of a kind that has
/// RandomCases.
Stimulus parse_stimulus(const std::string& text, const std::string& file, const tb::ChipKind& kind);

}  // namespace dsdpv1::cosim
