// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
// Bytes in a simulator's vector: the first in bits 7:0.
#include <cstdint>
#include <vector>

#include "bindings/simulator/simulator.h"

namespace dsdpv1::simulator {

inline uint8_t byte_at(const uint32_t* vector, std::size_t index) {
  return static_cast<uint8_t>(vector[index / 4] >> (8 * (index % 4)));
}

/// Throws Error if `count` is not 0 to 256.
std::vector<uint8_t> bytes_of(const uint32_t* vector, int32_t count);
/// Fills the whole vector, with zeros after the bytes; returns how many were taken: at most 256.
int32_t write_bytes(uint32_t* vector, const uint8_t* bytes, std::size_t count);

}  // namespace dsdpv1::simulator
