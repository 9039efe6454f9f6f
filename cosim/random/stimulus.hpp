#pragma once
// Stimulus for lockstep runs without the bench: what happens at the chip's input pins, as short lines of text.
//
// Three lanes act at the same time: the bus (send, spike), the user at the host port (take, give, write, read, block,
// pin; spi, uart of the DSDPV1-RSU), the board (reset). Each action begins `delay` ticks after the one before it in its
// lane has ended; `sync` lets all lanes wait for each other. An action of user or board may be aimed: it waits for a
// part of an access of the chip, and `delay` counts from its begin.
#include <string>
#include <vector>

#include "bus/wire/uart.hpp"
#include "kinds/dsdpv1/random/access_parts.hpp"
#include "model/dsdpv1/pins.hpp"

namespace dsdpv1::cosim {

enum class Verb : std::uint8_t {
  kSend,   ///< a telegram at `rate`; then an answer is waited for, `reply_bits` bit times for its beginning
  kSpike,  ///< the line low for `low` ticks, whoever drives it
  kTake,   ///< R_REQ up, L_REQ and L_STA looked at every `low` ticks until both are 0, R_STA up (H2)
  kGive,   ///< both down
  kWrite,  ///< one byte: CSR, A and D `setup` before, WR low for `low`, all held for `hold`
  kRead,   ///< one byte: CSR and A `setup` before, RD low for `low`
  kBlock,  ///< `bytes` from `address` on, then their CRC, exclusive-ored with `value`, at `crc_address`
  kPin,    ///< one input pin to `value`
  kSpi,    ///< a frame: XSS falls, `lead` ticks, SCK `high` and `low` for each bit of `bytes`, `lag` ticks, XSS rises
  kUart,   ///< a telegram at RXD; then a reply is waited for, `reply_bits` bit times for its beginning
  kReset,  ///< RESET low for `low` ticks, then high
  kSync,
};

/// One action; members that its verb does not name are not used.
struct Action {
  Verb verb = Verb::kSync;
  Tick delay = 0;
  int rate = 0, reply_bits = 0;
  int address = 0, crc_address = 0, value = 0;
  Tick setup = 200, low = 600, hold = 200;
  Tick high = 600, lead = 600, lag = 600;  ///< kSpi; MOSI changes `setup` before each rise of SCK
  Tick pause = 0;                          ///< ... between two bytes, besides
  int bits = 0;                            ///< ... all there are, 0: those of `bytes`
  int ppm = 0;                             ///< kUart: bits are longer by so many millionths
  AccessPart during = AccessPart::kNone;   ///< aimed at
  Tick within = 0;                         ///< ... but so long is waited for it at most
  Pin pin{};
  bus::Bytes bytes = {};
  bus::WireFaults faults = {};
};

using Stimulus = std::vector<Action>;

/// The text of a stimulus file: comments, one action a line.
std::string to_text(const Stimulus& stimulus);
/// Reads it; lines between `repeat COUNT` (1 to 1000) and `end` count COUNT times, at most a million in all. `file` is
/// for messages only, `part` the chip that it is played to. Throws tb::InputError, also for actions and pins that the
/// chip has not.
Stimulus parse_stimulus(const std::string& text, const std::string& file, Part part);

}  // namespace dsdpv1::cosim
