// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
// Converts packed pins and halves of a cycle, see simulator.h, for the C API.
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "dsdpv1/dsdpv1.h"

namespace dsdpv1::simulator {

constexpr int64_t kTicksPerHalf = DPSIM_TICKS_PER_CYCLE / 2;

inline uint64_t tick_of(int64_t half, int64_t ps) {
  const int64_t after = std::clamp<int64_t>((ps * DPSIM_TICKS_PER_NS + 500) / 1000, 0, kTicksPerHalf - 1);
  return static_cast<uint64_t>(half * kTicksPerHalf + after);
}

/// Tells a clocked module when to call next: the half cycle of `tick`; if that is the present one, a negative number:
/// so many ps after its edge.
inline int64_t wake_of(uint64_t tick, int64_t half) {
  if (tick > DPSIM_LAST_TICK) return INT64_MAX;
  const auto at = static_cast<int64_t>(tick);
  if (at / kTicksPerHalf > half) return at / kTicksPerHalf;
  return -std::max<int64_t>(((at - half * kTicksPerHalf) * 500 + 3) / 6, 1);
}

/// Up to this tick, some 8 days, absolute times fit products of 64 bits; dpsim_ticks_to and dpsim_ticks_from, which
/// divide 128 bits, handle later ones. The results are the same.
constexpr uint64_t kQuickTicks = uint64_t{1} << 53U;

/// Absolute, in ps; INT64_MAX: never.
inline int64_t ps_of(uint64_t tick) {
  if (tick < kQuickTicks) return static_cast<int64_t>((tick * 500 + 3) / 6);
  return tick > DPSIM_LAST_TICK ? INT64_MAX : static_cast<int64_t>(dpsim_ticks_to(tick, DPSIM_PS));
}

/// The tick nearest to an absolute time in ps.
inline uint64_t tick_of_ps(uint64_t ps) {
  if (ps < kQuickTicks) return (ps * DPSIM_TICKS_PER_NS + 500) / 1000;
  return dpsim_ticks_from(ps, DPSIM_PS);
}

/// Place of a pin in packed pins.
struct PinPlace {
  uint16_t pin = 0;
  std::string name;
  unsigned shift = 0;
  uint64_t level = 0;     ///< bits of its level, from `shift` on
  uint64_t released = 0;  ///< the bit for "released"; 0: it cannot be
  uint64_t unknown = 0;   ///< ... for "unknown", of an output
  uint64_t all() const { return level | released | unknown; }
};

/// One direction of a kind's pins, by their number: levels first, then the bits for released, then those for unknown.
class PackedPins {
 public:
  PackedPins() = default;
  PackedPins(const char* kind, bool inputs);

  const std::vector<PinPlace>& places() const { return places_; }
  uint64_t at_reset() const { return at_reset_; }
  const PinPlace& of_pin(uint16_t pin) const { return places_[of_pin_[pin]]; }
  /// The pin to which the lowest bit of `pins`, which is not 0, belongs.
  const PinPlace& first_of(uint64_t pins) const {
    return places_[of_bit_[static_cast<unsigned>(__builtin_ctzll(pins))]];
  }
  /// The bits of the levels only; throws Error if there is no such pin.
  uint64_t mask(const std::string& name) const;

 private:
  static constexpr std::size_t kPins = 64;  // of dpsim_pin_count, and bits of a packed number
  std::vector<PinPlace> places_;
  uint64_t at_reset_ = 0;
  std::array<uint8_t, kPins> of_pin_{}, of_bit_{};
};

/// The pins of a kind of chip as the C API lists them.
struct KindPins {
  std::string kind;
  PackedPins inputs, outputs;
};
/// Always valid; throws Error for an unknown kind.
const KindPins& pins_of_kind(const std::string& kind);

inline dpsim_level level_of(const PinPlace& place, uint64_t pins) {
  if ((pins & (place.released | place.unknown)) == 0)
    return static_cast<dpsim_level>((pins & place.level) >> place.shift);
  return (pins & place.unknown) != 0 ? DPSIM_X : DPSIM_Z;
}

/// Packed pins with another level for one pin.
inline uint64_t with_level(uint64_t pins, const PinPlace& place, dpsim_level level) {
  pins &= ~place.all();
  if (level == DPSIM_Z) return pins | place.released;
  return pins | (level == DPSIM_X ? place.unknown : static_cast<uint64_t>(level) << place.shift);
}

/// Calls `told` with the place and level of each pin that differs in `now`.
template <class Told>
void for_each_change(const PackedPins& pins, uint64_t before, uint64_t now, const Told& told) {
  for (uint64_t different = before ^ now; different != 0;) {
    const PinPlace& place = pins.first_of(different);
    told(place, level_of(place, now));
    different &= ~place.all();
  }
}

/// "5A", "Z", "X", "1".
std::string level_text(const PinPlace& place, dpsim_level level);
/// "cycle 76676 (1597.417 us)", "cycle 76672 + 122 ticks (1597.343 us)".
std::string time_text(uint64_t tick);

}  // namespace dsdpv1::simulator
