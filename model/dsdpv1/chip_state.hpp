// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
#pragma once
// What stands round a chip's state in its bytes: what it is, of which version, part and parameters, and a checksum.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/dsdpv1/config.hpp"
#include "model/profibus/state.hpp"

namespace dsdpv1 {

/// Counts up whenever what a block stores changes, or what it means.
constexpr std::uint32_t kStateVersion = 1;

/// The head of a state, to be followed by what the blocks store.
void begin_state(profibus::StateWriter& writer, const Config& config);
/// With size and checksum.
std::vector<std::uint8_t> end_state(std::vector<std::uint8_t> bytes);

/// What the blocks have stored, of bytes that are whole and of a chip with this part and these parameters; else throws.
profibus::StateReader open_state(const std::uint8_t* bytes, std::size_t size, const Config& config);
/// Throws when not all of it was right.
void check_state(const profibus::StateReader& reader);

}  // namespace dsdpv1
