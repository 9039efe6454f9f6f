#pragma once
// The addressee of a telegram.
#include <cstddef>
#include <cstdint>

#include "model/profibus/request.hpp"

namespace dsdpv1::profibus {

constexpr int kNoTelegram = -1, kForNobody = 128;

/// The station (0 to 126) of a valid telegram in these bytes, kBroadcast, or kForNobody (an acknowledgement, a token).
/// kNoTelegram: the bytes are not a telegram (S10).
int addressee(const std::uint8_t* bytes, std::size_t size);

}  // namespace dsdpv1::profibus
