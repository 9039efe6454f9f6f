#pragma once
// The times of FDL (rulings S3, S11): T_SYN, the synchronisation time that the line idles before a request; T_SDR, the
// station delay from the end of a request to the begin of its answer, from min_TSDR to max_TSDR (baud.hpp).
#include <algorithm>

#include "model/profibus/time.hpp"

namespace dsdpv1::profibus {

constexpr int kSynBits = 33;  ///< T_SYN, bit times
constexpr int kMinTsdr = 11;  ///< the least min_TSDR, bit times

/// Whether an idle time of `idle` cycles is T_SYN, `bit` cycles a bit: as the logic sees it, to the cycle.
constexpr bool is_syn(Cycle idle, int bit) { return idle >= static_cast<Cycle>(kSynBits) * bit - 1; }

/// T_SDR of an answer in cycles, `bit` cycles a bit: the min_TSDR of Set_Prm, as far as the rate allows; bit times.
constexpr Cycle tsdr(int min_tsdr, int max_tsdr, int bit) { return Cycle{std::min(min_tsdr, max_tsdr)} * bit; }

}  // namespace dsdpv1::profibus
