#pragma once
// Internal state of the sequencer that no pin shows: for waves and debuggers, never for the chip itself.
#include <cstdint>

#include "model/profibus/time.hpp"

namespace dsdpv1::dpram {

struct Inside {
  const char* item = "-";  ///< the item of the present access (ruling H4); "-": no access
  bool moves = false;      ///< in the cycle last evaluated a byte moved:
  std::uint16_t address = 0;
  std::uint8_t byte = 0;
  bool writes = false;       ///< to the DPRAM; else from it
  const char* crc_of = "-";  ///< the block whose CRC was checked last
  bool crc_right = false;
};

}  // namespace dsdpv1::dpram
