#pragma once
// The ten baud rates and the times of EN 50170 that depend on them. The index is that of table 5 of the datasheet.
#include <array>
#include <optional>
#include <string_view>

#include "bus/time.hpp"

namespace dsdpv1::bus {

/// One baud rate. Bit times are whole ticks at every rate (ruling S2: the chip's 48 MHz divided by a whole number).
struct Baud {
  std::string_view name;  ///< as in GSD files and scenarios: "12M" ... "9.6k"
  Tick bit;               ///< ticks of one bit
  int slot_bits;          ///< T_SL, bit times
  int max_tsdr_bits;      ///< latest answer of a slave, bit times (ruling S3)
  int set_bits;           ///< T_SET, bit times from an event to the reaction of a master
  int quiet_bits;         ///< T_QUI, bit times that a repeater needs to fall silent
};

constexpr int kBaudCount = 10;
constexpr Tick kTicksPerCycle = 250;  ///< 48 MHz cycles of the chip: 125/6 ns

/// Index 0 = 12 Mbit/s ... 9 = 9.6 kbit/s.
constexpr std::array<Baud, kBaudCount> kBauds = {{
    {"12M", 4 * kTicksPerCycle, 1000, 800, 16, 9},
    {"6M", 8 * kTicksPerCycle, 600, 450, 8, 6},
    {"3M", 16 * kTicksPerCycle, 400, 250, 4, 3},
    {"1.5M", 32 * kTicksPerCycle, 300, 150, 1, 0},
    {"500k", 96 * kTicksPerCycle, 200, 100, 1, 0},
    {"187.5k", 256 * kTicksPerCycle, 100, 60, 1, 0},
    {"93.75k", 512 * kTicksPerCycle, 100, 60, 1, 0},
    // Slaves may take 250 bit times here, so the slot time of the other slow rates (100) would end before their answer.
    {"45.45k", 1056 * kTicksPerCycle, 640, 250, 1, 0},
    {"19.2k", 2500 * kTicksPerCycle, 100, 60, 1, 0},
    {"9.6k", 5000 * kTicksPerCycle, 100, 60, 1, 0},
}};

/// `index` 0..9; throws std::out_of_range for others.
constexpr const Baud& baud(int index) { return kBauds.at(static_cast<std::size_t>(index)); }

/// The index of a name in the table, nullopt for any other text.
constexpr std::optional<int> baud_index(std::string_view name) {
  for (int i = 0; i < kBaudCount; ++i)
    if (baud(i).name == name) return i;
  return std::nullopt;
}

constexpr int kSynBits = 33;        ///< T_SYN: idle before every request, bit times
constexpr int kMinTsdrBits = 11;    ///< min_TSDR before a Set_Prm changed it, bit times
constexpr int kCharacterBits = 11;  ///< start, eight data, parity, stop

}  // namespace dsdpv1::bus
