#include "kinds/dsdpv1/random/serial_edges.hpp"

#include <algorithm>

#include "model/dsdpv1/config.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr int kByteBits = 8;
constexpr Tick kMillibits = 1000, kMillion = 1'000'000;

void in_order(std::vector<PinEdge>& edges) {
  std::stable_sort(
      edges.begin(), edges.end(), [](const PinEdge& a, const PinEdge& b) { return a.at < b.at; });
}

int bit_of(const bus::Bytes& bytes, int index) {
  const auto byte = bytes[static_cast<std::size_t>(index / kByteBits)];
  return byte >> (kByteBits - 1 - index % kByteBits) & 1;
}

/// The levels of a character at RXD, each with the millibits from the character's begin.
void add_character(std::vector<PinEdge>& edges, const bus::Character& character, Tick begin) {
  const Tick glitch = character.glitch ? character.glitch->start_millibits : -1;
  const Tick over = character.glitch ? glitch + character.glitch->length_millibits : -1;
  std::vector<Tick> instants;
  instants.reserve(static_cast<std::size_t>(character.bit_count) + 2);
  for (int i = 0; i < character.bit_count; ++i) instants.push_back(i * kMillibits);
  if (character.glitch) instants.insert(instants.end(), {glitch, over});
  for (const Tick instant : instants) {
    const Tick bit = instant / kMillibits;
    const bool level = bit >= character.bit_count || (character.bits >> bit & 1U) != 0;
    const bool inverted = instant >= glitch && instant < over;
    edges.push_back({begin + instant, Pin::kRxd, static_cast<Level>(level != inverted ? 1 : 0)});
  }
}

}  // namespace

Tick uart_bit(int rate) { return kUbrCycles.at(static_cast<std::size_t>(rate)) * profibus::kTicksPerCycle; }

std::vector<PinEdge> spi_edges(const Action& action) {
  const int all = kByteBits * static_cast<int>(action.bytes.size());
  const int bits = action.bits == 0 ? all : std::min(all, action.bits);
  std::vector<PinEdge> edges = {{0, Pin::kXss, 0}};
  Tick rise = action.lead, fall = 0;
  for (int i = 0; i < bits; ++i) {
    if (i > 0) rise = fall + action.low + (i % kByteBits == 0 ? action.pause : 0);
    fall = rise + action.high;
    edges.push_back({std::max<Tick>(0, rise - action.setup), Pin::kMosi, static_cast<Level>(bit_of(action.bytes, i))});
    edges.push_back({rise, Pin::kSck, 1});
    edges.push_back({fall, Pin::kSck, 0});
  }
  edges.push_back({(bits == 0 ? action.lead : fall) + action.lag, Pin::kXss, 1});
  in_order(edges);
  return edges;
}

std::vector<PinEdge> uart_edges(const Action& action) {
  std::vector<PinEdge> edges;
  Tick millibits = 0;
  for (const bus::Character& each : bus::characters(action.bytes, action.faults)) {
    millibits += each.gap_millibits;
    add_character(edges, each, millibits);
    millibits += each.bit_count * kMillibits;
  }
  edges.push_back({millibits, Pin::kRxd, 1});
  in_order(edges);
  const Tick bit = uart_bit(action.rate);
  for (PinEdge& edge : edges) edge.at = (edge.at * bit + edge.at * bit / kMillion * action.ppm) / kMillibits;
  return edges;
}

}  // namespace dsdpv1::cosim
