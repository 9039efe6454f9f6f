#pragma once
// Stimulus for lockstep runs without the bench: events at the chip's input pins, as short lines of text.
//
// Three lanes act in parallel: the bus (send, spike), the user at the host port (pin, and the kind's own verbs,
// RandomCases), the board (reset). Each action begins `delay` ticks after the end of the previous one in its lane;
// `sync` makes all lanes wait for each other. An action of user or board may be aimed: it waits for a part of a chip
// access, and `delay` counts from its begin.
//
// Lines `set chip.KEY=VALUE` are parameters of the model, as in --set.
#include <string>
#include <vector>

#include "bus/wire/uart.hpp"
#include "cosim/rtl.hpp"

namespace dsdpv1::cosim {

enum class Verb : std::uint8_t {
  kSend,   ///< a telegram at `rate`; then waits up to `reply_bits` bit times for the begin of an answer
  kSpike,  ///< the line is low for `low` ticks, whoever drives it
  kReset,  ///< RESET low for `low` ticks, then high
  kSync,
  kAlone,  ///< anywhere: PlayOptions::reads_back has no effect, for inputs that were recorded without it
  kPin,    ///< one input pin to `value`: the first one of the user's
  kHost,   ///< the kind's own verbs have this value and the following ones
};
constexpr Verb kLastVerb{0xFF};
constexpr Verb host_verb(int number) { return static_cast<Verb>(static_cast<int>(Verb::kHost) + number); }

/// One action; members not used by its verb are ignored.
struct Action {
  Verb verb = Verb::kSync;
  Tick delay = 0;
  Tick rate = 0, reply_bits = 0, address = 0, crc_address = 0, value = 0, bits = 0, ppm = 0;
  Tick setup = 200, low = 600, hold = 200, high = 600, lead = 600, lag = 600, pause = 0;
  const char* during = nullptr;  ///< the part at which it is aimed, from Vocabulary::access_parts
  Tick within = 0;               ///< ... and the maximum wait for it
  PinNumber pin = 0;
  bool joined = false;  ///< not in the file: the shrinker keeps it with the action before
  bus::Bytes bytes = {};
  bus::WireFaults faults = {};
};

using Stimulus = std::vector<Action>;

/// The text of a stimulus file for a chip of this kind: comments, one action per line.
std::string to_text(const Stimulus& stimulus, const tb::ChipKind& kind, const std::vector<std::string>& set = {});
/// Parses it; lines between `repeat COUNT` (1 to 1000) and `end` are repeated COUNT times, at most a million in total.
/// `file` is for messages only. Throws tb::InputError, also for actions and pins that the chip does not have. The kind
/// must have RandomCases.
Stimulus parse_stimulus(const std::string& text, const std::string& file, const tb::ChipKind& kind);
/// The parameters in its lines `set`, which parse_stimulus leaves out.
std::vector<std::string> settings_in(const std::string& text);

}  // namespace dsdpv1::cosim
