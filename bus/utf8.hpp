#pragma once
#include <cstddef>
#include <string_view>

namespace dsdpv1::bus {

/// Bytes of the well-formed UTF-8 sequence that begins at `at`, 0 when it is none.
std::size_t utf8_sequence(std::string_view text, std::size_t at);

}  // namespace dsdpv1::bus
