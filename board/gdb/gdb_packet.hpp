#pragma once
// The gdb remote serial protocol, from bytes to packets and back ("Debugging with GDB", appendix E.1).
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dsdpv1::arm {

/// The longest packet that gdb may send, without `$` and `#nn`. Also told to gdb, in hexadecimal (qSupported).
constexpr std::size_t kGdbPacketSize = 0x4000;

struct GdbInput {
  enum class Kind { kPacket, kWrongChecksum, kInterrupt, kRepeat };
  Kind kind;
  std::string packet;  ///< of kPacket: what stands between `$` and `#`, binary data still escaped
};

/// Puts packets together from pieces as a network delivers them.
class GdbReader {
 public:
  void take(std::string_view bytes) { bytes_ += bytes; }
  /// The next thing that is complete. A packet that is too long counts as one with a wrong checksum.
  std::optional<GdbInput> next();

 private:
  std::optional<GdbInput> next_packet();

  std::string bytes_;
};

/// `$payload#nn`
std::string gdb_frame(std::string_view payload);

/// Undoes the escapes of binary data: 0x7D, then the byte XOR 0x20.
std::string gdb_unescape(std::string_view data);

/// Two digits a byte.
std::string to_hex(const std::uint8_t* bytes, std::size_t count);
inline std::string to_hex(std::string_view text) {
  return to_hex(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}
/// nullopt when it is not pairs of digits.
std::optional<std::string> from_hex(std::string_view digits);

/// Reads a packet from left to right.
class GdbFields {
 public:
  explicit GdbFields(std::string_view text) : text_(text) {}
  /// Skips `prefix` when it comes next.
  bool skip(std::string_view prefix);
  /// Skips a hexadecimal number when one of up to 32 bits comes next.
  std::optional<std::uint32_t> number();
  /// "address,size"
  struct Range {
    std::uint32_t address, size;
  };
  std::optional<Range> range();
  std::string_view rest() const { return text_; }

 private:
  std::string_view text_;
};

}  // namespace dsdpv1::arm
