// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
#pragma once
// The head of a chip's state: frame, part, parameters.
#include <cstddef>
#include <cstdint>

#include "model/dsdpv1/config.hpp"
#include "model/profibus/state_frame.hpp"

namespace dsdpv1 {

/// Increment when the content or meaning of a block's stored state changes.
constexpr std::uint32_t kStateVersion = 2;

/// Writes the head of a state; the blocks store after it.
void begin_state(profibus::StateWriter& writer, const Config& config);
/// Returns the blocks' part of a complete state of this part and these parameters; throws otherwise.
profibus::StateReader open_state(const std::uint8_t* bytes, std::size_t size, const Config& config);

}  // namespace dsdpv1
