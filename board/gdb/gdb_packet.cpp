#include "board/gdb/gdb_packet.hpp"

#include <algorithm>
#include <charconv>
#include <numeric>

namespace dsdpv1::arm {
namespace {

constexpr char kInterrupt = '\x03';
constexpr char kEscape = '\x7D';

unsigned checksum(std::string_view payload) {
  return std::accumulate(
      payload.begin(), payload.end(), 0U,
      [](unsigned sum, char c) { return (sum + static_cast<unsigned char>(c)) & 0xFFU; });
}

/// The value of all of `digits`.
std::optional<std::uint32_t> value_of(std::string_view digits) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return value;
}

}  // namespace

std::optional<GdbInput> GdbReader::next() {
  while (!bytes_.empty()) {
    const char first = bytes_.front();
    if (first == '$') return next_packet();
    bytes_.erase(0, 1);
    if (first == kInterrupt) return GdbInput{GdbInput::Kind::kInterrupt, ""};
    if (first == '-') return GdbInput{GdbInput::Kind::kRepeat, ""};
    // Else '+', which needs nothing done, or noise between two packets.
  }
  return std::nullopt;
}

std::optional<GdbInput> GdbReader::next_packet() {
  const std::size_t hash = bytes_.find('#');
  const bool complete = hash != std::string::npos && bytes_.size() >= hash + 3;
  if (!complete && bytes_.size() <= kGdbPacketSize + 4) return std::nullopt;
  // Data have no bare '$': a second one begins another packet.
  const std::size_t start = complete ? bytes_.rfind('$', hash) + 1 : 0;
  const bool right = complete && hash - start <= kGdbPacketSize &&
                     value_of(std::string_view(bytes_).substr(hash + 1, 2)) ==
                         checksum(std::string_view(bytes_).substr(start, hash - start));
  GdbInput input{GdbInput::Kind::kWrongChecksum, ""};
  if (right) input = {GdbInput::Kind::kPacket, bytes_.substr(start, hash - start)};
  bytes_.erase(0, complete ? hash + 3 : bytes_.size());
  return input;
}

std::string gdb_frame(std::string_view payload) {
  const auto sum = static_cast<std::uint8_t>(checksum(payload));
  return "$" + std::string(payload) + "#" + to_hex(&sum, 1);
}

std::string gdb_unescape(std::string_view data) {
  std::string bytes;
  for (std::size_t i = 0; i < data.size(); ++i) {
    const bool escaped = data[i] == kEscape && i + 1 < data.size();
    bytes += escaped ? static_cast<char>(data[++i] ^ 0x20) : data[i];
  }
  return bytes;
}

std::string to_hex(const std::uint8_t* bytes, std::size_t count) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text;
  text.reserve(2 * count);
  for (std::size_t i = 0; i < count; ++i) {
    text += kDigits[bytes[i] >> 4U];
    text += kDigits[bytes[i] & 0xFU];
  }
  return text;
}

std::optional<std::string> from_hex(std::string_view digits) {
  if (digits.size() % 2 != 0) return std::nullopt;
  std::string bytes;
  for (std::size_t i = 0; i < digits.size(); i += 2) {
    const auto byte = value_of(digits.substr(i, 2));
    if (!byte) return std::nullopt;
    bytes += static_cast<char>(*byte);
  }
  return bytes;
}

bool GdbFields::skip(std::string_view prefix) {
  if (text_.substr(0, prefix.size()) != prefix) return false;
  text_.remove_prefix(prefix.size());
  return true;
}

std::optional<std::uint32_t> GdbFields::number() {
  const auto end = std::min(text_.find_first_not_of("0123456789abcdefABCDEF"), text_.size());
  const auto value = value_of(text_.substr(0, end));
  if (value) text_.remove_prefix(end);
  return value;
}

std::optional<GdbFields::Range> GdbFields::range() {
  const auto address = number();
  if (!address || !skip(",")) return std::nullopt;
  const auto size = number();
  if (!size) return std::nullopt;
  return Range{*address, *size};
}

}  // namespace dsdpv1::arm
