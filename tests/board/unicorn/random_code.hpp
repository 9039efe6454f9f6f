#pragma once
// Random instructions of the whole ARMv7-M integer set with behaviour defined by the architecture: nothing
// UNPREDICTABLE, branches only forwards and to instructions.
#include <cstdint>
#include <random>
#include <vector>

namespace dsdpv1::arm::differential {

using Random = std::mt19937_64;

/// Registers reserved so that most accesses hit memory.
constexpr unsigned kIndexRegister = 5;  ///< a multiple of 4, 0 to 252
constexpr unsigned kBusRegister = 9;    ///< points into the bus, others of kBases into RAM
constexpr std::uint16_t kEnd = 0xBE00;  ///< BKPT, after the last one

/// Code of about `count` instructions for kCode, ended by kEnd.
std::vector<std::uint8_t> random_code(Random& random, unsigned count);

}  // namespace dsdpv1::arm::differential
