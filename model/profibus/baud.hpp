#pragma once
// The ten bit rates, in the order of table 5 (and of the search): index 0 = 12 Mbit/s ... 9 = 9.6 kbit/s.
#include <array>

#include "model/profibus/time.hpp"

namespace profibus {

constexpr int kBaudCount = 10;
constexpr int kBaudUnknown = 15;  ///< table 5: the baud rate is being searched

/// Cycles a bit (ruling S2).
constexpr std::array<int, kBaudCount> kBitCycles = {4, 8, 16, 32, 96, 256, 512, 1056, 2500, 5000};
/// max_TSDR in bit times (ruling S3, chapter 11's GSD).
constexpr std::array<int, kBaudCount> kMaxTsdr = {800, 450, 250, 150, 100, 60, 60, 250, 60, 60};

constexpr int kMinTsdr = 11;           ///< bit times, S3
constexpr int kSynBits = 33;           ///< T_SYN, S3
constexpr int kBitsPerCharacter = 11;  ///< start, 8 data, even parity, stop

}  // namespace profibus
