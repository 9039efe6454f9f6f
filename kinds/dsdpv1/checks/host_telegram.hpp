#pragma once
// Telegrams of the host to a DSDPV1-RSU over SPI (SP4) and its UART (UA5, UA7), as far as the checks follow them.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace dsdpv1::checks {

/// The third: over SPI read and write (SP16), over the UART exchange (UA7).
enum class TelegramKind : std::uint8_t { kRead, kWrite, kExchange };

enum class SerialPort : std::uint8_t { kSpi, kUart };

constexpr unsigned kOwnershipCell = 0x014, kUartIntervalCell = 0x019, kUartTsdrCell = 0x01A;

/// A request, byte by byte.
class HostTelegram {
 public:
  explicit HostTelegram(SerialPort port) : port_(port) {}

  void clear() { bytes_.clear(); }
  void add(std::uint8_t byte) { bytes_.push_back(byte); }
  std::size_t size() const { return bytes_.size(); }

  /// The first byte is a telegram's (SP11). From here on at least one byte is there.
  bool begins() const { return bytes_[0] >> 5 <= 2 && (bytes_[0] & 0x1C) == 0; }
  unsigned card() const { return bytes_[0] & 3U; }
  TelegramKind kind() const { return static_cast<TelegramKind>(bytes_[0] >> 5); }
  /// All bytes up to where the length byte says are there.
  bool complete() const;

  // Of a complete one.
  /// CRC (R15), address and length are right (SP10, UA5): it is carried out unless the chip is busy (SP13). Not asked
  /// of an exchange (UA9).
  bool right() const;
  /// A read or write of this cell.
  bool covers(unsigned cell) const { return cell >= address() && cell < address() + count(); }
  /// What a write that covers the cell writes there; absent for another telegram.
  std::optional<std::uint8_t> written(unsigned cell) const;
  unsigned address() const { return (static_cast<unsigned>(bytes_[1]) << 8 | bytes_[2]) & 0x7FFU; }

 private:
  bool addressed() const { return kind() != TelegramKind::kExchange; }
  /// Place of the length byte.
  std::size_t length_at() const { return addressed() ? 3 : port_ == SerialPort::kSpi ? 1 : 4; }
  unsigned count() const { return bytes_[length_at()]; }
  unsigned most_data() const;

  SerialPort port_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace dsdpv1::checks
