#include "kinds/dsdpv1/pins/diagrams.hpp"

#include "bus/baud.hpp"
#include "model/dsdpv1/pins.hpp"

namespace dsdpv1::tb {
namespace {

using Edges = std::vector<DiagramEdge>;

DiagramEdge rise(Pin pin) { return {number(pin), Turn::kRise}; }
DiagramEdge fall(Pin pin) { return {number(pin), Turn::kFall}; }
DiagramEdge change(Pin pin) { return {number(pin), Turn::kChange}; }
DiagramEdge value(Pin pin) { return {number(pin), Turn::kValue}; }
DiagramEdge only(DiagramEdge edge, Pin where, Level level) {
  edge.where.at(edge.conditions++) = {number(where), level};
  return edge;
}

/// P5: in an access CSR and the strobe are both low.
Edges begin(Pin strobe) { return {only(fall(strobe), Pin::kCsr, 0), only(fall(Pin::kCsr), strobe, 0)}; }
/// The later of them began an access that is still running.
Edges falls(Pin strobe) { return {fall(strobe), fall(Pin::kCsr)}; }
Edges end(Pin strobe) { return {only(rise(strobe), Pin::kCsr, 0), only(rise(Pin::kCsr), strobe, 0)}; }
Edges at(Edges edges, Level address) {
  for (DiagramEdge& edge : edges) edge = only(edge, Pin::kA, address);
  return edges;
}
Edges either(Edges one, const Edges& other) {
  one.insert(one.end(), other.begin(), other.end());
  return one;
}

/// The last tick at which A may change before the chip samples it: P5, the first edge of CLK after `begun` (P9).
bus::Tick last_before_sampling(bus::Tick begun) { return (begun / bus::kTicksPerCycle + 1) * bus::kTicksPerCycle - 1; }

Moment here() { return {}; }
Moment before(Edges edges) { return {Moment::Of::kBefore, std::move(edges)}; }
Moment before_sampling(Edges edges) {
  return {Moment::Of::kBefore, std::move(edges), falls(Pin::kRd), last_before_sampling};
}
Moment in_read(Edges edges) { return {Moment::Of::kSince, std::move(edges), falls(Pin::kRd)}; }
Moment after(Edges edges) { return {Moment::Of::kAfter, std::move(edges)}; }
Moment sample() { return {Moment::Of::kReadSample, {}}; }
Moment request_end() { return {Moment::Of::kRequestEnded, {}}; }

std::vector<PinNumber> pins(std::initializer_list<Pin> list) {
  std::vector<PinNumber> numbers;
  for (const Pin each : list) numbers.push_back(number(each));
  return numbers;
}

/// Figures 4 and 5: R_REQ, samples of L_REQ and L_STA, R_STA, the first access.
TimingDiagram take() {
  return {
      "take",
      "The user takes the DPRAM",
      "R_REQ, the chip goes away (L_REQ and L_STA low), R_STA, the first access (5.1, figures 4 and 5).",
      {rise(Pin::kRSta)},
      {{"request to ownership", before({rise(Pin::kRReq)}), here(), "OWNERSHIP_SYNC_WINDOW"},
       {"chip away to ownership", before({rise(Pin::kRReq), fall(Pin::kLSta)}), here(), "OWNERSHIP_BOTH_OWN"},
       {"ownership to first access", here(), after(either(begin(Pin::kRd), begin(Pin::kWr))), "OWNERSHIP_NOT_OWNER"}},
      20 * bus::kTicksPerUs,
      pins({Pin::kRReq, Pin::kRSta, Pin::kLReq, Pin::kLSta, Pin::kCsr, Pin::kRd, Pin::kWr})};
}

/// Figure 5: the first fall ends the ownership; H1: the later one completes the release.
TimingDiagram give_back() {
  const Edges complete = {only(fall(Pin::kRSta), Pin::kRReq, 0), only(fall(Pin::kRReq), Pin::kRSta, 0)};
  return {
      "give_back",
      "The user gives the DPRAM back",
      "The last access ends, R_STA and R_REQ fall, the chip comes (5.1, figure 5).",
      {only(fall(Pin::kRSta), Pin::kRReq, 1), only(fall(Pin::kRReq), Pin::kRSta, 1)},
      {{"last access to release", before(either(end(Pin::kRd), end(Pin::kWr))), here(), "OWNERSHIP_RELEASED_IN_ACCESS"},
       {"both low to the chip's request", after(complete), after({rise(Pin::kLReq)})}},
      20 * bus::kTicksPerUs,
      pins({Pin::kRReq, Pin::kRSta, Pin::kLReq, Pin::kLSta, Pin::kCsr, Pin::kRd, Pin::kWr})};
}

TimingDiagram read() {
  return {"read",
          "A read of the user",
          "A valid before RD and CSR are low; D is sampled, then one of them rises (table 15, P11).",
          end(Pin::kRd),
          {{"Tc", before_sampling({change(Pin::kA)}), before(falls(Pin::kRd)), "TIMING_TC"},
           {"Tw", before(falls(Pin::kRd)), sample(), "TIMING_TW"},
           {"RD to the chip's data", before(falls(Pin::kRd)), in_read({value(Pin::kDOut)})}},
          0,
          pins({Pin::kCsr, Pin::kRd, Pin::kWr, Pin::kA, Pin::kDIn, Pin::kDOut})};
}

TimingDiagram write() {
  return {"write",
          "A write of the user",
          "A and D valid, WR low, and both held after WR rose (table 15, P11).",
          {only(rise(Pin::kWr), Pin::kCsr, 0)},
          {{"Ts", before({fall(Pin::kWr)}), here(), "TIMING_TS"},
           {"Td before", before({change(Pin::kA), change(Pin::kDIn)}), here(), "TIMING_TD"},
           {"Td after, A", here(), after({change(Pin::kA)}), "TIMING_ADDRESS_HOLD"},
           {"Td after, D", here(), after({change(Pin::kDIn)}), "TIMING_DATA_HOLD"},
           {"CSR after WR", here(), after({rise(Pin::kCsr)}), "TIMING_CSR"}},
          bus::kTicksPerUs,
          pins({Pin::kCsr, Pin::kWr, Pin::kRd, Pin::kA, Pin::kDIn, Pin::kDOut})};
}

TimingDiagram interrupt() {
  constexpr Level kB00e = 0x00E;                       // P7: tells what has arrived
  constexpr bus::Tick kTb = 64 * bus::kTicksPerCycle;  // 1.333 us
  return {"intr0",
          "INTR0 and who serves it",
          "INTR0 falls, the user takes the DPRAM and reads B00E (4.1.6, 5.2, table 16).",
          {fall(Pin::kIntr0)},
          {{"Tb, INTR0 low", here(), after({rise(Pin::kIntr0)}), nullptr, false, kTb, "table 16, P7"},
           {"INTR0 to request", here(), after({rise(Pin::kRReq)})},
           {"INTR0 to the read of B00E", here(), after(at(begin(Pin::kRd), kB00e)), "INTR0_SERVICE"}},
          100 * bus::kTicksPerMs,
          pins({Pin::kIntr0, Pin::kRReq, Pin::kRSta, Pin::kLReq, Pin::kLSta, Pin::kRd, Pin::kA})};
}

TimingDiagram answer() {
  return {"answer",
          "From request to answer",
          "The request's last stop bit ends, PBRTS rises, the answer's first start bit falls (TSDR).",
          {},
          {{"request to PBRTS", request_end(), before({rise(Pin::kPbrts)})},
           {"TSDR", request_end(), here(), nullptr, true, 0, "EN 50170, S3"}},
          0,
          pins({Pin::kPbrxd, Pin::kPbrts, Pin::kPbtxd})};
}

}  // namespace

const std::vector<TimingDiagram>& dsdpv1_timing_diagrams() {
  static const std::vector<TimingDiagram> diagrams = {take(), give_back(), read(), write(), interrupt(), answer()};
  return diagrams;
}

const std::vector<BusyTime>& dsdpv1_busy_times() {
  static const std::vector<BusyTime> times = {
      {"Holds of the user (R_REQ or R_STA high)", dsdpv1::mask(Pin::kRReq) | dsdpv1::mask(Pin::kRSta)},
      {"Accesses of the chip (L_REQ or L_STA high)", dsdpv1::mask(Pin::kLReq) | dsdpv1::mask(Pin::kLSta)}};
  return times;
}

}  // namespace dsdpv1::tb
