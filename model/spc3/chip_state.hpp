#pragma once
// The head of a chip's state: frame, name, parameters.
#include <cstddef>
#include <cstdint>

#include "model/profibus/state_frame.hpp"
#include "model/spc3/config.hpp"

namespace dsdpv1::spc3 {

/// Increment when the content or meaning of a block's stored state changes.
constexpr std::uint32_t kStateVersion = 2;

/// Writes the head of a state; the blocks store after it.
void begin_state(profibus::StateWriter& writer, const Config& config);
/// Returns the blocks' part of a complete state of this name and these parameters; throws otherwise.
profibus::StateReader open_state(const std::uint8_t* bytes, std::size_t size, const Config& config);

}  // namespace dsdpv1::spc3
