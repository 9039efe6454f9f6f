#pragma once
// Simulated time outside the chip. One tick is 1/12 ns, so that a 48 MHz cycle (125/6 ns = 250 ticks), half a cycle
// (125 ticks), 12.5 ns (150 ticks) and every PROFIBUS bit time (4 cycles at 12 Mbit/s) are whole numbers: nothing is
// rounded.
#include <cstdint>
#include <limits>

namespace dsdpv1::bus {

using Tick = std::int64_t;

constexpr Tick kTicksPerNs = 12;
constexpr Tick kTicksPerUs = 12'000;
constexpr Tick kTicksPerMs = 12'000'000;
constexpr Tick kTicksPerSecond = 12'000'000'000;
constexpr Tick kNever = std::numeric_limits<Tick>::max();

}  // namespace dsdpv1::bus
