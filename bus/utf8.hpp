#pragma once
#include <cstddef>
#include <string_view>

namespace dsdpv1::bus {

/// Size in bytes of the well-formed UTF-8 sequence at `at`, 0 without one.
std::size_t utf8_sequence(std::string_view text, std::size_t at);

}  // namespace dsdpv1::bus
