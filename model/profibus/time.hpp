#pragma once
// Time inside the core. Blocks count 48 MHz cycles; only the host port, which is asynchronous to CLK, needs the finer
// tick.
#include <cstdint>
#include <limits>

namespace dsdpv1::profibus {

/// 48 MHz cycles (125/6 ns) since the start of simulation. The rising CLK edge of cycle n is at tick n * 250.
using Cycle = std::int64_t;
/// 1/12 ns: a cycle is 250 ticks, half a cycle 125, 12.5 ns 150.
using Tick = std::int64_t;

constexpr Tick kTicksPerCycle = 250;
constexpr Tick kTicksPerNs = 12;
constexpr Cycle kNever = std::numeric_limits<Cycle>::max();
constexpr Cycle kCyclesPerMs = 48'000;

/// The first rising edge that sees a change made at `t`: the first one strictly after it (ruling P9).
constexpr Cycle first_edge_after(Tick t) { return t / kTicksPerCycle + 1; }

}  // namespace dsdpv1::profibus
