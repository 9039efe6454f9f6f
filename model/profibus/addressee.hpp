#pragma once
// Who a telegram is for.
#include <cstddef>
#include <cstdint>

#include "model/profibus/request.hpp"

namespace dsdpv1::profibus {

constexpr int kNoTelegram = -1, kForNobody = 128;

/// Of a right telegram in these bytes: the station (0 to 126), kBroadcast, or kForNobody (an acknowledgement, a token).
/// kNoTelegram: it is none (S10).
int addressee(const std::uint8_t* bytes, std::size_t size);

}  // namespace dsdpv1::profibus
