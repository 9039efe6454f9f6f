#pragma once
// The times of FDL (rulings S3, S11): T_SYN, the minimum idle time before a request; T_SDR, the station delay from the
// end of a request to the begin of its answer, from min_TSDR to max_TSDR (baud.hpp).
#include <algorithm>

#include "model/profibus/time.hpp"

namespace dsdpv1::profibus {

constexpr int kSynBits = 33;  ///< T_SYN, bit times
constexpr int kMinTsdr = 11;  ///< the least min_TSDR, bit times

/// Whether `idle` cycles are T_SYN at `bit` cycles per bit: as seen by the logic, exact to the cycle.
constexpr bool is_syn(Cycle idle, int bit) { return idle >= static_cast<Cycle>(kSynBits) * bit - 1; }

/// T_SDR of an answer in cycles, at `bit` cycles per bit: the min_TSDR of Set_Prm in bit times, limited by the rate.
constexpr Cycle tsdr(int min_tsdr, int max_tsdr, int bit) { return Cycle{std::min(min_tsdr, max_tsdr)} * bit; }

}  // namespace dsdpv1::profibus
