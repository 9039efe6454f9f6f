#pragma once
// The blocks of a diagnosis that the host gives (4.4.3, 4.4.4, X16): an alarm or a status, then channels.
#include <cstdint>

namespace dsdpv1::xgate {

struct DiagnosisBlocks {
  bool right = false;    ///< all bytes belong to blocks that the data sheet knows
  bool alarm = false;    ///< the first block is an alarm
  bool channel = false;  ///< there is a block of a channel
};

/// `size`: 0 to 255. No bytes are a right diagnosis without blocks.
DiagnosisBlocks read_diagnosis(const std::uint8_t* bytes, int size);

}  // namespace dsdpv1::xgate
