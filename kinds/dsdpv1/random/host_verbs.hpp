#pragma once
// Actions of a DSDPV1's user in stimulus files, with the numbers of an Action that parameterise them.
#include "cosim/random/random_cases.hpp"
#include "model/dsdpv1/part.hpp"

namespace dsdpv1::cosim {

namespace verb {
/// Raises R_REQ, samples L_REQ and L_STA every `low` ticks until both are 0, raises R_STA (H2).
constexpr Verb kTake = host_verb(0);
/// Lowers both.
constexpr Verb kGive = host_verb(1);
/// One byte: CSR, A and D `setup` before, WR low for `low`, all held for `hold`.
constexpr Verb kWrite = host_verb(2);
/// One byte: CSR and A `setup` before, RD low for `low`.
constexpr Verb kRead = host_verb(3);
/// `bytes` from `address` on, then their CRC, XORed with `value`, at `crc_address`.
constexpr Verb kBlock = host_verb(4);
/// A frame: XSS falls at tick 0; after `lead` ticks SCK is `high` and `low` for each of `bits` (0: all bits of
/// `bytes`), with MOSI set `setup` before each rise and `pause` added between two bytes; after `lag` ticks XSS rises.
constexpr Verb kSpi = host_verb(5);
/// A telegram on RXD from the first start bit at tick 0 to the end of the last bit, where RXD is high again, with bits
/// longer by `ppm` millionths; then waits up to `reply_bits` bit times for the begin of a reply.
constexpr Verb kUart = host_verb(6);
}  // namespace verb

/// Ticks per bit of the UART by UBR's code (UA1), 0 to 7.
Tick uart_bit(Tick rate);
/// kSpi, kUart; in order of time.
std::vector<PinEdge> spi_edges(const Action& action);
std::vector<PinEdge> uart_edges(const Action& action);

/// Vocabulary::verbs.
std::vector<VerbRow> verbs_of(Part part);

}  // namespace dsdpv1::cosim
