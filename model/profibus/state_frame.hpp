// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
#pragma once
// The frame of a chip's saved state: magic, version, size and a checksum; then the chip's kind, parameters and blocks.
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/profibus/state.hpp"

namespace dsdpv1::profibus {

/// Why bytes are not a valid state: one line.
class StateError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct StateFrame {
  std::uint64_t magic = 0;    ///< of the family of chips
  std::uint32_t version = 0;  ///< of its format
};

/// Writes the head of a state.
void begin_frame(StateWriter& writer, const StateFrame& frame);
/// Adds size and checksum to a state whose last byte is written.
std::vector<std::uint8_t> end_frame(std::vector<std::uint8_t> bytes);

/// Returns the part of a complete state after its head; throws if it is another frame's, cut or damaged.
StateReader open_frame(const std::uint8_t* bytes, std::size_t size, const StateFrame& frame);
/// Throws unless the state was saved with the chip's own title, parameter.
void check_title(const std::string& saved, const std::string& own);
void check_parameter(StateReader& reader, const char* name, std::uint32_t own);
/// After the last value: throws if any was wrong, or bytes are left.
void check_frame(const StateReader& reader);

}  // namespace dsdpv1::profibus
