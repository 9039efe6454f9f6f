// P1: deviation of the chip's and the master's crystals from the capture's clock.
#include <fmt/format.h>

#include "bus/wire/uart.hpp"
#include "kinds/dsdpv1/claims/found.hpp"

namespace dsdpv1::calibrate {
namespace {

const Claim kClock = {"P1", "CLK is 48 MHz, as far as two crystals may differ", {wire::kPbtxd}};

/// Bits from the first start bit to the last edge of a telegram, the edge before its last stop bit.
int bits_to_last_edge(const bus::Bytes& bytes) {
  const std::uint16_t bits = bus::Character::of(bytes.back()).bits;
  int last = bus::kCharacterBits - 1;
  while ((bits >> (last - 1) & 1) != 0) --last;
  return static_cast<int>(bytes.size() - 1) * bus::kCharacterBits + last;
}

/// The sender's cycles per cycle of the capture.
Estimate clock_of(const std::vector<LineTelegram>& telegrams, const Trace& trace, const TimeBase& time) {
  std::vector<Instance> instances;
  for (const LineTelegram& telegram : telegrams) {
    if (!telegram.right) continue;
    const std::size_t edge = trace.last(telegram.end(), true);
    if (edge == Trace::kNone || trace.edges[edge] <= telegram.start) continue;
    const double right = bits_to_last_edge(telegram.bytes) * telegram.bit(),
                 seen = TimeBase::nominal(trace.edges[edge] - telegram.start);
    if (seen <= 2 * time.doubt()) continue;
    instances.push_back({telegram.start, {right / (seen + time.doubt()), right / (seen - time.doubt())}, right / seen});
  }
  return estimate(instances);
}

}  // namespace

void measure_clock(Scene& scene, double limit_ppm, Found& found) {
  found.master_clock = clock_of(scene.received, scene.record[wire::kPbrxd], scene.time);
  found.clock = clock_of(scene.sent, scene.record[wire::kPbtxd], scene.time);
  const Span possible{1 - limit_ppm * 1e-6, 1 + limit_ppm * 1e-6};
  scene.time.scale = possible;
  if (found.clock.count == 0) return;
  const Span& measured = found.clock.span;
  if (overlap(measured, possible)) {
    found.judge.holds(kClock);
    scene.time.scale = common(measured, possible);
  } else {
    found.judge.fails(kClock, scene.sent.front().start,
                      fmt::format("{:+.0f} ppm, expected at most {:.0f}", (measured.middle() - 1) * 1e6, limit_ppm));
    scene.time.scale = measured;
  }
}

ClaimList clock_claims() { return {&kClock}; }

}  // namespace dsdpv1::calibrate
