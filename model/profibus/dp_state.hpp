#pragma once
#include <cstdint>

namespace dsdpv1::profibus {

/// The states of the DP slave, in the coding of table 5.
enum class DpState : std::uint8_t { kOffline = 0, kWaitPrm = 1, kWaitCfg = 2, kDataExch = 3 };

}  // namespace dsdpv1::profibus
