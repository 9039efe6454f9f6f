#pragma once
// Decodes host telegrams of a DSDPV1-RSU (SP4, SP10, SP16, UA5, UA7 to UA13), also to text.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "bus/bytes.hpp"

namespace dsdpv1::tb {

enum class HostLink : std::uint8_t { kSpi, kUart };

/// The third: over SPI read and write (SP16), over the UART exchange (UA7).
enum class TelegramKind : std::uint8_t { kRead, kWrite, kExchange };

/// A request of the user, byte by byte.
class HostRequest {
 public:
  explicit HostRequest(HostLink link) : link_(link) {}
  void clear() {
    bytes_.clear();
    size_ = 0;
  }
  void add(std::uint8_t byte) {
    if (size_++ < kMost) bytes_.push_back(byte);
  }
  bool empty() const { return bytes_.empty(); }
  std::size_t size() const { return size_; }
  /// Bytes after the longest possible telegram add no information and are dropped.
  const bus::Bytes& bytes() const { return bytes_; }

  // The following need at least one byte.
  /// The first byte can begin a telegram (SP11).
  bool begins() const { return kind() <= TelegramKind::kExchange && (bytes_[0] & 0x1C) == 0; }
  unsigned card() const { return bytes_[0] & 3U; }
  TelegramKind kind() const { return static_cast<TelegramKind>(bytes_[0] >> 5U); }
  bool complete() const { return begins() && bytes_.size() == size_needed(); }

  // The following need a complete telegram.
  bool is_exchange() const { return link_ == HostLink::kUart && kind() == TelegramKind::kExchange; }
  unsigned length() const { return bytes_[length_at()]; }
  unsigned address() const { return static_cast<unsigned>(bytes_[address_at()]) << 8 | bytes_[address_at() + 1]; }
  /// CRC (R15), address and length are right (SP10, UA5): it is executed unless the chip is busy (SP13). Areas of an
  /// exchange are not checked (UA9).
  bool right() const;
  /// A read or write of this cell.
  bool covers(unsigned cell) const { return cell >= address() && cell < address() + length(); }
  /// The value that a write to the cell writes; absent for another telegram.
  std::optional<std::uint8_t> written(unsigned cell) const;

  /// "write B020, length 23, card 1, CRC right"; as much as is known of an incomplete one.
  std::string words() const;
  /// "CRC 18CF, computed 4711"; empty if its CRC is right.
  std::string wrong() const;

 private:
  static constexpr std::size_t kMost = 512;

  bool has_address() const { return link_ == HostLink::kUart || kind() != TelegramKind::kExchange; }
  std::size_t address_at() const { return is_exchange() ? 2 : 1; }
  std::size_t length_at() const { return has_address() ? address_at() + 2 : 1; }
  /// The size according to its length byte; absent until that has been received.
  std::optional<std::size_t> size_needed() const;
  unsigned most_data() const;
  const char* name() const;

  HostLink link_;
  bus::Bytes bytes_;
  std::size_t size_ = 0;
};

/// The chip's reply to a request.
class HostReply {
 public:
  void clear() { bytes_.clear(); }
  void add(std::uint8_t byte) { bytes_.push_back(byte); }
  bool empty() const { return bytes_.empty(); }
  const bus::Bytes& bytes() const { return bytes_; }

  bool complete(const HostRequest& request) const { return bytes_.size() == size_needed(request); }
  /// "reply to read, length 1, code 00, card 1, CRC right"; as much as is known of an incomplete one.
  std::string words(const HostRequest& request) const;
  /// As for a request; needs a complete reply.
  std::string wrong() const;

 private:
  std::optional<std::size_t> size_needed(const HostRequest& request) const;
  std::string exchange_words() const;
  bool is_error() const { return bytes_[0] >> 5U == 7; }

  bus::Bytes bytes_;
};

}  // namespace dsdpv1::tb
