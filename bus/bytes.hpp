#pragma once
// Octets of telegrams, in the order in which they are on the wire.
#include <cstdint>
#include <vector>

namespace dsdpv1::bus {

using Bytes = std::vector<std::uint8_t>;

}  // namespace dsdpv1::bus
