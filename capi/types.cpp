// Version and time.
#include "dsdpv1/types.h"
#include "capi/names.hpp"

#include <array>
#include <cstdint>

namespace {

__extension__ using Wide = unsigned __int128;

/// A unit as a fraction of ticks.
struct Unit {
  std::uint64_t ticks, units;
};
constexpr std::array<Unit, 7> kUnits = {{{12, 1'000'000},
                                         {12, 1'000},
                                         {12, 1},
                                         {12'000, 1},
                                         {12'000'000, 1},
                                         {12'000'000'000, 1},
                                         {DPSIM_TICKS_PER_CYCLE, 1}}};

bool is_unit(dpsim_unit unit) { return unit >= 0 && unit < static_cast<dpsim_unit>(kUnits.size()); }

Wide rounded(std::uint64_t value, std::uint64_t by, std::uint64_t over) {
  return (Wide{value} * by * 2 + over) / (Wide{over} * 2);
}

}  // namespace

uint32_t dpsim_abi_version() { return DPSIM_ABI_MAJOR * 65536U + DPSIM_ABI_MINOR; }
const char* dpsim_version() { return DSDPV1_VERSION; }

uint64_t dpsim_ticks_from(uint64_t time, dpsim_unit unit) {
  if (!is_unit(unit)) return DPSIM_NEVER;
  const Unit& each = kUnits.at(static_cast<std::size_t>(unit));
  const Wide ticks = rounded(time, each.ticks, each.units);
  return ticks > DPSIM_LAST_TICK ? DPSIM_NEVER : static_cast<std::uint64_t>(ticks);
}

uint64_t dpsim_ticks_to(uint64_t ticks, dpsim_unit unit) {
  if (!is_unit(unit) || ticks == DPSIM_NEVER) return UINT64_MAX;
  const Unit& each = kUnits.at(static_cast<std::size_t>(unit));
  const Wide time = rounded(ticks, each.units, each.ticks);
  return time > UINT64_MAX ? UINT64_MAX : static_cast<std::uint64_t>(time);
}
