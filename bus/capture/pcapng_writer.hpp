#pragma once
// Telegrams as a pcapng file (draft-ietf-opsawg-pcapng), little endian, for Wireshark and the like.
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "bus/baud.hpp"
#include "bus/capture/captured_telegram.hpp"

namespace dsdpv1::bus::capture {

/// Bytes of the file, in order. They hang on the telegrams alone: nothing of the machine and of today is in them.
using WriteBytes = std::function<void(std::string_view)>;

struct PcapngHeader {
  std::uint16_t link = 257;
  std::string application;  ///< that writes the file
  int baud = 0;             ///< of the first interface
};

class PcapngWriter {
 public:
  /// Writes the section header and an interface.
  PcapngWriter(const PcapngHeader& header, WriteBytes write);
  /// A packet at the time of the telegram's start, nanoseconds since the start of the run. An interface for each rate,
  /// written before its first telegram. Where the end is not that of the characters at this rate, a comment says so.
  void telegram(const CapturedTelegram& telegram);

 private:
  std::uint32_t interface_of(int baud);

  std::uint16_t link_;
  WriteBytes write_;
  std::array<std::optional<std::uint32_t>, kBaudCount> interfaces_ = {};  ///< by rate
  std::uint32_t interface_count_ = 0;
};

}  // namespace dsdpv1::bus::capture
