#pragma once
// A telegram of the host, by SPI or UART (SP4, SP10, SP11, UA5, UA7): collects its bytes and judges it.
#include <array>
#include <cstdint>

#include "model/dpram/crc16.hpp"
#include "model/dpram/ram.hpp"
#include "model/profibus/event_log.hpp"

namespace dsdpv1 {

/// Bits 7..5 of the first byte. An exchange transfers both ways: SPI's read and write, UART's exchange (010).
enum class Command : std::uint8_t { kRead, kWrite, kExchange };

/// How the two ports differ.
struct TelegramRules {
  bool names_area;  ///< an exchange names an area (UART); else it is of the inputs, with the length byte as data (SPI)
  int most;         ///< bytes of the longest telegram (error bit 3) ...
  int most_exchange;  ///< ... and of the longest exchange
  int most_write;     ///< data bytes of a write
};
inline constexpr TelegramRules kSpiRules = {false, 251, 251, 245};
inline constexpr TelegramRules kUartRules = {true, 256, 257, 250};
constexpr int kMostRead = 245;          ///< data bytes of a read
constexpr int kMostReadAndWrite = 244;  ///< inputs of SPI's read and write
/// The areas of an exchange (UA9), and how many data bytes each takes.
struct ExchangeArea {
  std::uint16_t address;
  int most;
};
inline constexpr std::array<ExchangeArea, 4> kExchangeAreas = {
    {{regs::kInput, 245}, {regs::kDiag, 240}, {regs::kC1, 244}, {regs::kC2, 244}}};
constexpr std::uint8_t kWithDiagnosis = 0x02;  ///< function bit 1 of an exchange: B227 is meant

/// Error codes of a reply (SP10).
constexpr std::uint8_t kCrcWrong = 0x01, kAddressWrong = 0x02, kDataWrong = 0x04, kLengthWrong = 0x08;

/// A complete telegram.
struct Request {
  Command command = Command::kRead;
  std::uint8_t function = 0;  ///< for an exchange
  std::uint16_t address = 0;  ///< as received, 16 bits; 0x130 for a read and write
  int length = 0;             ///< its length byte
  int bytes = 0;              ///< in total, including the CRC
  std::uint16_t crc = 0, computed = 0;

  template <class Archive>
  void store(Archive& archive) {
    auto& [kind, what, cell, data, all, sent, made] = *this;
    archive.within(0, 3, kind);  // 3: no telegram
    archive(what, cell, sent, made);
    archive.within(0, 0xFF, data);
    archive.within(0, kMostBytes, all);
  }
  static constexpr int kMostBytes = 0xFF + 7;  ///< of the longest: data, header of an exchange, CRC

  regs::Address base() const { return address % regs::kDpramSize; }
  bool covers(regs::Address cell) const { return base() <= cell && cell < base() + length; }
  bool crc_right() const { return crc == computed; }
};

class HostTelegram {
 public:
  explicit HostTelegram(const TelegramRules& rules) : rules_(rules) {}

  /// The next byte is the first.
  void restart() {
    count_ = 0;
    crc_ = 0xFFFF;
  }
  /// Returns true with the last byte; request() is then complete.
  bool add(std::uint8_t byte);

  /// Bytes so far, and bytes of the whole telegram, 0: not known yet.
  int count() const { return count_; }
  int bytes() const { return bytes_; }
  std::uint8_t start() const { return start_; }
  bool is_telegram() const { return start_ >> 5 <= 2 && (start_ & 0x1C) == 0; }
  bool is_for(int address) const { return (start_ & 3) == address && (address == 1 || address == 2); }

  const Request& request() const { return request_; }
  /// Data of the last write or exchange, up to kMostData; of SPI's read and write its length byte first.
  const std::uint8_t* data() const { return data_.data(); }

  /// The error code for a telegram with a right CRC; each fault is reported at `now`.
  std::uint8_t judge(const Request& request, profibus::Cycle now, profibus::EventLog& log) const;

  static constexpr int kMostData = 250;

  template <class Archive>
  void store(Archive& archive) {
    auto& [rules, count, bytes, start, crc, request, data] = *this;
    archive.given(rules);
    archive.within(0, 1 << 30, count);
    archive.within(0, Request::kMostBytes, bytes);
    archive(start, crc, request, data);
  }

 private:
  void begin(std::uint8_t byte);
  void take_header(int index, std::uint8_t byte);
  void take_length(std::uint8_t length);
  bool is_of_area(const Request& request) const { return rules_.names_area && request.command == Command::kExchange; }
  int header() const;
  std::uint8_t judge_address(const Request& request, profibus::Cycle now, profibus::EventLog& log) const;
  std::uint8_t judge_data(const Request& request, profibus::Cycle now, profibus::EventLog& log) const;
  int most_data(const Request& request) const;

  const TelegramRules& rules_;
  int count_ = 0, bytes_ = 0;
  std::uint8_t start_ = 0;
  std::uint16_t crc_ = 0xFFFF;
  Request request_;
  std::array<std::uint8_t, kMostData> data_{};
};

}  // namespace dsdpv1
