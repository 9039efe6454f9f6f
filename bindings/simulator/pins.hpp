// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
// Packed pins and halves of a cycle, as simulator.h has them, and what they are for the C API.
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "dsdpv1/dsdpv1.h"

namespace dsdpv1::simulator {

constexpr int64_t kTicksPerHalf = DPSIM_TICKS_PER_CYCLE / 2;

inline uint64_t tick_of(int64_t half, int64_t ps) {
  const int64_t after = std::clamp<int64_t>((ps * DPSIM_TICKS_PER_NS + 500) / 1000, 0, kTicksPerHalf - 1);
  return static_cast<uint64_t>(half * kTicksPerHalf + after);
}

/// The first half cycle that does not begin before `tick`.
inline int64_t half_of(uint64_t tick) {
  if (tick > DPSIM_LAST_TICK) return INT64_MAX;
  return (static_cast<int64_t>(tick) + kTicksPerHalf - 1) / kTicksPerHalf;
}

/// Up to here, some 8 days, absolute times fit products of 64 bits; dpsim_ticks_to and dpsim_ticks_from, which divide
/// 128 bits, serve what is beyond. The results are the same.
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

struct PinPlace {
  uint16_t pin;
  const char* name;
  int shift;
  uint32_t mask;  ///< in its place, with what says that it is released or unknown
};

constexpr uint32_t kDInShift = 17, kDReleased = 1U << 25U, kDOutShift = 8, kDDriven = 1U << 16U, kDUnknown = 1U << 17U;
constexpr uint32_t kUnknownShift = 18, kSingles = 8;

constexpr std::array<PinPlace, 9> kInputs{{{DPSIM_DSDPV1_RESET, "RESET", 0, 1U << 0U},
                                           {DPSIM_DSDPV1_R_REQ, "R_REQ", 1, 1U << 1U},
                                           {DPSIM_DSDPV1_R_STA, "R_STA", 2, 1U << 2U},
                                           {DPSIM_DSDPV1_CSR, "CSR", 3, 1U << 3U},
                                           {DPSIM_DSDPV1_RD, "RD", 4, 1U << 4U},
                                           {DPSIM_DSDPV1_WR, "WR", 5, 1U << 5U},
                                           {DPSIM_DSDPV1_A, "A", 6, 0x7FFU << 6U},
                                           {DPSIM_DSDPV1_D_IN, "D_IN", kDInShift, (0xFFU << kDInShift) | kDReleased},
                                           {DPSIM_DSDPV1_PBRXD, "PBRXD", 26, 1U << 26U}}};
/// CSR, RD, WR and PBRXD high, D released: the levels of power-on.
constexpr uint32_t kInputsAtReset = 0x38U | kDReleased | 1U << 26U;

constexpr uint32_t single(int bit) { return (1U << bit) | (1U << (kUnknownShift + static_cast<uint32_t>(bit))); }
constexpr std::array<PinPlace, 9> kOutputs{
    {{DPSIM_DSDPV1_L_REQ, "L_REQ", 0, single(0)},
     {DPSIM_DSDPV1_L_STA, "L_STA", 1, single(1)},
     {DPSIM_DSDPV1_D_OUT, "D_OUT", kDOutShift, (0xFFU << kDOutShift) | kDDriven | kDUnknown},
     {DPSIM_DSDPV1_INTR0, "INTR0", 2, single(2)},
     {DPSIM_DSDPV1_PBTXD, "PBTXD", 3, single(3)},
     {DPSIM_DSDPV1_PBRTS, "PBRTS", 4, single(4)},
     {DPSIM_DSDPV1_PBF, "PBF", 5, single(5)},
     {DPSIM_DSDPV1_BR, "BR", 6, single(6)},
     {DPSIM_DSDPV1_READY, "READY", 7, single(7)}}};

/// The level of an input in packed pins.
inline dpsim_level input_level(const PinPlace& place, uint32_t pins) {
  if (place.pin == DPSIM_DSDPV1_D_IN && (pins & kDReleased) != 0) return DPSIM_Z;
  return static_cast<dpsim_level>((pins & place.mask & ~kDReleased) >> place.shift);
}

/// The level of an output in packed pins.
inline dpsim_level output_level(const PinPlace& place, uint32_t pins) {
  if (place.pin == DPSIM_DSDPV1_D_OUT) {
    if ((pins & kDDriven) == 0) return DPSIM_Z;
    return (pins & kDUnknown) != 0 ? DPSIM_X : static_cast<dpsim_level>((pins >> kDOutShift) & 0xFFU);
  }
  if ((pins >> (kUnknownShift + static_cast<uint32_t>(place.shift)) & 1U) != 0) return DPSIM_X;
  return static_cast<dpsim_level>(pins >> place.shift & 1U);
}

/// Packed outputs in which one has another level.
inline uint32_t with_output(uint32_t pins, const PinPlace& place, dpsim_level level) {
  pins &= ~place.mask;
  if (place.pin != DPSIM_DSDPV1_D_OUT) return pins | static_cast<uint32_t>(level) << place.shift;
  if (level == DPSIM_Z) return pins;
  return pins | kDDriven | (level == DPSIM_X ? kDUnknown : static_cast<uint32_t>(level) << kDOutShift);
}

/// "5A", "Z", "X", "1".
std::string level_text(const PinPlace& place, dpsim_level level);
/// "cycle 76676 (1597.417 us)", "cycle 76672 + 122 ticks (1597.343 us)".
std::string time_text(uint64_t tick);

}  // namespace dsdpv1::simulator
