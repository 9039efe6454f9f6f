#pragma once
// The resource manager's registry (table 30): which master holds which C2 channel.
#include <array>
#include <cstdint>

namespace dsdpv1::profibus {

constexpr int kC2Channels = 2, kC2FirstSap = 48;  ///< channel k has SAP 48 - k: 0x30, 0x2F

struct RmEntry {
  std::uint8_t master = 0;  ///< its address; 0 while not in use
  bool in_use = false;      ///< lent to a master
  bool connected = false;   ///< the initiate answer has been fetched
  bool exchanging = false;  ///< a request is open

  /// In use, connected, exchanging as bits 0, 1, 2.
  unsigned bits() const {
    return static_cast<unsigned>(in_use) | static_cast<unsigned>(connected) << 1 |
           static_cast<unsigned>(exchanging) << 2;
  }
};

using RmRegistry = std::array<RmEntry, kC2Channels>;

}  // namespace dsdpv1::profibus
