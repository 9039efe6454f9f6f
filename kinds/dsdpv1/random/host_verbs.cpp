#include "kinds/dsdpv1/random/host_verbs.hpp"

#include <algorithm>

#include "model/dpram/crc16.hpp"
#include "model/dsdpv1/config.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr Tick kLongest = Tick{1} << 40;
constexpr int kLastCell = 0x7FF;

PinEdge edge(Tick at, Pin pin, Level level) { return {at, number(pin), level}; }

UserPlan take(const Action& action) {
  constexpr Tick kSeen = 4 * profibus::kTicksPerCycle;
  return {{edge(0, Pin::kRReq, 1),
           {kSeen, kNoPin, 0, mask(Pin::kLReq) | mask(Pin::kLSta)},
           edge(kSeen + action.low, Pin::kRSta, 1)},
          action.low};
}

UserPlan give(const Action& /*action*/) { return {{edge(0, Pin::kRSta, 0), edge(0, Pin::kRReq, 0)}}; }

/// Returns the end of the access.
Tick add_write(UserPlan& plan, Tick begin, const Action& action, Tick address, Tick value) {
  const Tick fall = begin + action.setup, rise = fall + action.low, end = rise + action.hold;
  plan.edges.insert(plan.edges.end(), {edge(begin, Pin::kA, static_cast<Level>(address & kLastCell)),
                                       edge(begin, Pin::kDIn, static_cast<Level>(value)), edge(begin, Pin::kCsr, 0),
                                       edge(fall, Pin::kWr, 0), edge(rise, Pin::kWr, 1), edge(end, Pin::kCsr, 1),
                                       edge(end, Pin::kDIn, dsdpv1::kLevelZ)});
  return end;
}

UserPlan write(const Action& action) {
  UserPlan plan;
  add_write(plan, 0, action, action.address, action.value);
  return plan;
}

UserPlan read(const Action& action) {
  const Tick rise = action.setup + action.low;
  return {{edge(0, Pin::kA, static_cast<Level>(action.address)), edge(0, Pin::kCsr, 0), edge(action.setup, Pin::kRd, 0),
           edge(rise, Pin::kRd, 1), edge(rise + action.hold, Pin::kCsr, 1)}};
}

UserPlan block(const Action& action) {
  const Tick crc = dpram::crc16(action.bytes.data(), static_cast<int>(action.bytes.size())) ^ action.value;
  UserPlan plan;
  Tick end = 0;
  Tick address = action.address;
  for (const std::uint8_t each : action.bytes) end = add_write(plan, end, action, address++, each);
  end = add_write(plan, end, action, action.crc_address, crc >> 8);
  add_write(plan, end, action, action.crc_address + 1, crc & 0xFF);
  return plan;
}

UserPlan pin(const Action& action) { return {{{0, action.pin, static_cast<Level>(action.value)}}}; }

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

/// The levels of a character on RXD, each with the millibits from the character's begin.
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
    edges.push_back({begin + instant, number(Pin::kRxd), static_cast<Level>(level != inverted ? 1 : 0)});
  }
}

UserPlan spi(const Action& action) { return {spi_edges(action)}; }

UserPlan uart(const Action& action) {
  return {uart_edges(action), 0, action.reply_bits, number(Pin::kTxd), uart_bit(action.rate)};
}

}  // namespace

Tick uart_bit(Tick rate) { return kUbrCycles.at(static_cast<std::size_t>(rate)) * profibus::kTicksPerCycle; }

std::vector<PinEdge> spi_edges(const Action& action) {
  const int all = kByteBits * static_cast<int>(action.bytes.size());
  const Tick bits = action.bits == 0 ? all : std::min<Tick>(all, action.bits);
  std::vector<PinEdge> edges = {{0, number(Pin::kXss), 0}};
  Tick rise = action.lead, fall = 0;
  for (int i = 0; i < bits; ++i) {
    if (i > 0) rise = fall + action.low + (i % kByteBits == 0 ? action.pause : 0);
    fall = rise + action.high;
    edges.push_back(
        {std::max<Tick>(0, rise - action.setup), number(Pin::kMosi), static_cast<Level>(bit_of(action.bytes, i))});
    edges.push_back({rise, number(Pin::kSck), 1});
    edges.push_back({fall, number(Pin::kSck), 0});
  }
  edges.push_back({(bits == 0 ? action.lead : fall) + action.lag, number(Pin::kXss), 1});
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
  edges.push_back({millibits, number(Pin::kRxd), 1});
  in_order(edges);
  const Tick bit = uart_bit(action.rate);
  for (PinEdge& edge : edges) edge.at = (edge.at * bit + edge.at * bit / kMillion * action.ppm) / kMillibits;
  return edges;
}

std::vector<VerbRow> verbs_of(Part part) {
  const Field at{"at", &Action::address, 0, kLastCell, true}, crc{"crc", &Action::crc_address, 0, kLastCell, true},
      change{"xor", &Action::value, 0, 0xFFFF, true}, byte{"value", &Action::value, 0, 0xFF, true},
      level{"level", &Action::value, -1, kLastCell}, setup{"setup", &Action::setup, 0, kLongest},
      low{"low", &Action::low, 1, kLongest}, hold{"hold", &Action::hold, 0, kLongest},
      high{"high", &Action::high, 1, kLongest}, lead{"lead", &Action::lead, 0, kLongest},
      lag{"lag", &Action::lag, 0, kLongest}, pause{"pause", &Action::pause, 0, kLongest},
      bits{"bits", &Action::bits, 0, 1'000'000}, rate{"rate", &Action::rate, 0, 7},
      reply{"reply", &Action::reply_bits, 0, 2000}, ppm{"ppm", &Action::ppm, -100'000, 100'000},
      poll{"poll", &Action::low, 1, kLongest};
  std::vector<VerbRow> verbs = {{verb::kTake, "take", {poll}, take},
                                {verb::kGive, "give", {}, give},
                                {verb::kWrite, "write", {at, byte, setup, low, hold}, write},
                                {verb::kRead, "read", {at, setup, low, hold}, read},
                                {verb::kBlock, "block", {at, crc, change, setup, low, hold}, block},
                                {Verb::kPin, "pin", {level}, pin}};
  if (!has_serial_ports(part)) return verbs;
  verbs.push_back({verb::kSpi, "spi", {setup, high, low, lead, lag, pause, bits}, spi});
  verbs.push_back({verb::kUart, "uart", {rate, reply, ppm}, uart, true});
  return verbs;
}

}  // namespace dsdpv1::cosim
