// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
#include "bindings/simulator/bytes.hpp"

#include <algorithm>

#include "bindings/simulator/object.hpp"

namespace dsdpv1::simulator {

std::vector<uint8_t> bytes_of(const uint32_t* vector, int32_t count) {
  if (count < 0 || count > DSDPV1_BYTES)
    throw Error(DPSIM_ERR_ARGUMENT, "number of bytes is " + std::to_string(count) + ", expected 0 to 256");
  std::vector<uint8_t> bytes(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = byte_at(vector, i);
  return bytes;
}

int32_t write_bytes(uint32_t* vector, const uint8_t* bytes, std::size_t count) {
  const std::size_t taken = std::min<std::size_t>(count, DSDPV1_BYTES);
  std::fill(vector, vector + DSDPV1_BYTES / 4, 0U);
  for (std::size_t i = 0; i < taken; ++i) vector[i / 4] |= static_cast<uint32_t>(bytes[i]) << (8 * (i % 4));
  return static_cast<int32_t>(taken);
}

}  // namespace dsdpv1::simulator
