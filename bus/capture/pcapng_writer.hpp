#pragma once
// Writes telegrams to a pcapng file (draft-ietf-opsawg-pcapng), little endian, for Wireshark and similar tools.
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "bus/baud.hpp"
#include "bus/capture/captured_telegram.hpp"

namespace dsdpv1::bus::capture {

/// Receives the bytes of the file, in order. They depend only on the telegrams, not on the machine or the date.
using WriteBytes = std::function<void(std::string_view)>;

struct PcapngHeader {
  std::uint16_t link = 257;
  std::string application;  ///< the program that writes the file
  int baud = 0;             ///< of the first interface
};

class PcapngWriter {
 public:
  /// Writes the section header and an interface.
  PcapngWriter(const PcapngHeader& header, WriteBytes write);
  /// Writes a packet at the telegram's start, in nanoseconds since the start of the run. Each rate has an interface,
  /// written before its first telegram. If the end does not match the characters at this rate, a comment says so.
  void telegram(const CapturedTelegram& telegram);

 private:
  std::uint32_t interface_of(int baud);

  std::uint16_t link_;
  WriteBytes write_;
  std::array<std::optional<std::uint32_t>, kBaudCount> interfaces_ = {};  ///< by rate
  std::uint32_t interface_count_ = 0;
};

}  // namespace dsdpv1::bus::capture
