#pragma once
// What the user of a DSDPV1 can do in stimulus files, with the numbers of an Action that say how.
#include "cosim/random/random_cases.hpp"
#include "model/dsdpv1/part.hpp"

namespace dsdpv1::cosim {

namespace verb {
/// R_REQ up, L_REQ and L_STA looked at every `low` ticks until both are 0, R_STA up (H2).
constexpr Verb kTake = host_verb(0);
/// Both down.
constexpr Verb kGive = host_verb(1);
/// One byte: CSR, A and D `setup` before, WR low for `low`, all held for `hold`.
constexpr Verb kWrite = host_verb(2);
/// One byte: CSR and A `setup` before, RD low for `low`.
constexpr Verb kRead = host_verb(3);
/// `bytes` from `address` on, then their CRC, exclusive-ored with `value`, at `crc_address`.
constexpr Verb kBlock = host_verb(4);
/// A frame: XSS falls at tick 0, `lead` ticks, SCK `high` and `low` for each of `bits` (0: those of `bytes`), before
/// each rise MOSI by `setup`, `pause` besides between two bytes, `lag` ticks, XSS rises.
constexpr Verb kSpi = host_verb(5);
/// A telegram at RXD from the first start bit at tick 0 to the end of the last bit, where RXD is high again, bits
/// longer by `ppm` millionths; then a reply is waited for, `reply_bits` bit times for its beginning.
constexpr Verb kUart = host_verb(6);
}  // namespace verb

/// Ticks of a bit of the UART by UBR's code (UA1), 0 to 7.
Tick uart_bit(Tick rate);
/// kSpi, kUart; in order of time.
std::vector<PinEdge> spi_edges(const Action& action);
std::vector<PinEdge> uart_edges(const Action& action);

/// Vocabulary::verbs.
std::vector<VerbRow> verbs_of(Part part);

}  // namespace dsdpv1::cosim
