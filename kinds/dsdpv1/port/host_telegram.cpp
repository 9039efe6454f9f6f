#include "kinds/dsdpv1/port/host_telegram.hpp"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "kinds/dsdpv1/port/crc16.hpp"

namespace dsdpv1::tb {
namespace {

constexpr std::size_t kCrcBytes = 2;
constexpr unsigned kCells = 0x800, kMostData = 245, kMostInputs = 244, kMostOverUart = 250;
constexpr unsigned kFunctionError = 0x80;

struct CrcOf {
  unsigned received, computed;
  bool right() const { return received == computed; }
};

/// For a telegram that has at least its CRC.
CrcOf crc_of(const bus::Bytes& bytes) {
  const std::size_t covered = bytes.size() - kCrcBytes;
  Crc16 crc;
  for (std::size_t i = 0; i < covered; ++i) crc.add(bytes[i]);
  return {static_cast<unsigned>(bytes[covered]) << 8 | bytes[covered + 1], crc.value()};
}

const char* crc_word(const bus::Bytes& bytes) { return crc_of(bytes).right() ? "CRC right" : "CRC wrong"; }

std::string crc_fault(const bus::Bytes& bytes) {
  const CrcOf crc = crc_of(bytes);
  return crc.right() ? "" : fmt::format("CRC {:04X}, computed {:04X}", crc.received, crc.computed);
}

/// The words of the set bits, the lowest first; empty if none is set.
template <std::size_t N>
std::string bit_words(unsigned value, const std::array<const char*, N>& words) {
  std::vector<const char*> found;
  for (std::size_t bit = 0; bit < N; ++bit)
    if ((value >> bit & 1U) != 0 && words.at(bit) != nullptr) found.push_back(words.at(bit));
  return found.empty() ? "" : fmt::format(" ({})", fmt::join(found, ", "));
}

/// SP10.
std::string code_words(unsigned code) {
  static constexpr std::array<const char*, 4> kBits = {"CRC", "address", "data length", "telegram length"};
  return fmt::format("code {:02X}{}", code, bit_words(code, kBits));
}

/// UA10.
std::string function_words(unsigned function) {
  static constexpr std::array<const char*, 8> kBits = {"data exchange", nullptr,         "C1",    "C2",
                                                       "parameters",    "configuration", nullptr, "error"};
  return fmt::format("function {:02X}{}", function, bit_words(function, kBits));
}

}  // namespace

// ------------------------------------------------------------------------------------------------------------- request

std::optional<std::size_t> HostRequest::size_needed() const {
  if (bytes_.size() <= length_at()) return std::nullopt;
  const std::size_t data = kind() == TelegramKind::kRead ? 0 : length();
  return length_at() + 1 + data + kCrcBytes;
}

unsigned HostRequest::most_data() const {
  return link_ == HostLink::kUart && kind() == TelegramKind::kWrite ? kMostOverUart : kMostData;
}

bool HostRequest::right() const {
  if (!crc_of(bytes_).right()) return false;
  if (kind() == TelegramKind::kExchange) return length() <= kMostInputs;
  return length() >= 1 && length() <= most_data() && address() + length() <= kCells;
}

std::optional<std::uint8_t> HostRequest::written(unsigned cell) const {
  if (kind() != TelegramKind::kWrite || !covers(cell)) return std::nullopt;
  return bytes_[length_at() + 1 + cell - address()];
}

const char* HostRequest::name() const {
  switch (kind()) {
    case TelegramKind::kRead: return "read";
    case TelegramKind::kWrite: return "write";
    default: return link_ == HostLink::kUart ? "exchange" : "read and write";
  }
}

std::string HostRequest::words() const {
  if (!begins()) return fmt::format("no telegram: begins with {:02X}", bytes_[0]);
  if (!complete()) return fmt::format("{}, card {}", name(), card());
  const std::string where = has_address() ? fmt::format(" B{:03X}", address()) : "";
  const std::string function = is_exchange() ? fmt::format(", function {:02X}", bytes_[1]) : "";
  return fmt::format("{}{}{}, length {}, card {}, {}", name(), where, function, length(), card(), crc_word(bytes_));
}

std::string HostRequest::wrong() const { return complete() ? crc_fault(bytes_) : ""; }

// --------------------------------------------------------------------------------------------------------------- reply

std::optional<std::size_t> HostReply::size_needed(const HostRequest& request) const {
  constexpr std::size_t kShort = 4, kExchangeError = 5, kExchangeLength = 4, kSpiLength = 2;
  if (request.is_exchange()) {
    if (bytes_.size() < 2) return std::nullopt;
    if ((bytes_[1] & kFunctionError) != 0) return kExchangeError;
    if (bytes_.size() <= kExchangeLength) return std::nullopt;
    return kExchangeLength + 1 + bytes_[kExchangeLength] + kCrcBytes;
  }
  switch (bytes_[0] >> 5U) {
    case 4: return kShort + request.length();
    case 6:
      if (bytes_.size() <= kSpiLength) return std::nullopt;
      return kSpiLength + 1 + bytes_[kSpiLength] + kCrcBytes;
    default: return kShort;
  }
}

std::string HostReply::exchange_words() const {
  const char* const crc = crc_word(bytes_);
  if ((bytes_[1] & kFunctionError) != 0)
    return fmt::format("error to exchange, {}, {}, card {}, {}", code_words(bytes_[2]), function_words(bytes_[1]),
                       bytes_[0], crc);
  const unsigned address = static_cast<unsigned>(bytes_[2]) << 8 | bytes_[3];
  return fmt::format("reply with B{:03X}, {}, length {}, card {}, {}", address, function_words(bytes_[1]), bytes_[4],
                     bytes_[0], crc);
}

std::string HostReply::words(const HostRequest& request) const {
  if (!complete(request)) return "reply";
  if (request.is_exchange()) return exchange_words();
  const std::string rest = fmt::format("{}, card {}, {}", code_words(bytes_[1]), bytes_[0] & 3U, crc_word(bytes_));
  switch (bytes_[0] >> 5U) {
    case 4: return fmt::format("reply to read, length {}, {}", request.length(), rest);
    case 5: return "reply to write, " + rest;
    case 6: return fmt::format("reply to read and write, length {}, {}", bytes_[2], rest);
    default: return (is_error() && bytes_[1] == 0 ? "refused, " : "error, ") + rest;
  }
}

std::string HostReply::wrong() const { return crc_fault(bytes_); }

}  // namespace dsdpv1::tb
