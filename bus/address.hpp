#pragma once
// Addresses of stations.
#include <cstdint>

namespace dsdpv1::bus {

constexpr std::uint8_t kHighestAddress = 126;  ///< for a station
constexpr std::uint8_t kBroadcast = 127;       ///< all stations

}  // namespace dsdpv1::bus
