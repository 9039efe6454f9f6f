#include "tests/conformance/host_telegrams.hpp"

namespace dsdpv1::conformance {
namespace {

std::uint16_t document_crc(const Bytes& bytes) {
  unsigned crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int i = 0; i < 8; ++i) crc = (crc & 1U) != 0 ? crc >> 1 ^ 0xA001U : crc >> 1;
  }
  return static_cast<std::uint16_t>(crc);
}

std::uint8_t high(std::uint16_t word) { return static_cast<std::uint8_t>(word >> 8); }
std::uint8_t low(std::uint16_t word) { return static_cast<std::uint8_t>(word & 0xFF); }

Bytes joined(Bytes head, const Bytes& data) {
  head.insert(head.end(), data.begin(), data.end());
  return head;
}

}  // namespace

Bytes with_crc(Bytes bytes, std::uint16_t error) {
  const auto crc = static_cast<std::uint16_t>(document_crc(bytes) ^ error);
  bytes.push_back(high(crc));
  bytes.push_back(low(crc));
  return bytes;
}

Bytes read_telegram(std::uint16_t address, std::uint8_t length, std::uint8_t card) {
  return with_crc({card, high(address), low(address), length});
}
Bytes write_telegram(std::uint16_t address, const Bytes& data, std::uint8_t card) {
  return with_crc(joined(
      {static_cast<std::uint8_t>(0x20 | card), high(address), low(address), static_cast<std::uint8_t>(data.size())},
      data));
}
Bytes inputs_telegram(const Bytes& inputs, std::uint8_t card) {
  return with_crc(joined({static_cast<std::uint8_t>(0x40 | card), static_cast<std::uint8_t>(inputs.size())}, inputs));
}
Bytes exchange_telegram(std::uint8_t function, std::uint16_t address, const Bytes& data, std::uint8_t card) {
  return with_crc(joined({static_cast<std::uint8_t>(0x40 | card), function, high(address), low(address),
                          static_cast<std::uint8_t>(data.size())},
                         data));
}

}  // namespace dsdpv1::conformance
