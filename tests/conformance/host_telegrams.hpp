#pragma once
// Telegrams of a host to the SPI and the UART port of a DSDPV1-RSU, and CRCs of the replies.
#include <cstdint>

#include "bus/bytes.hpp"

namespace dsdpv1::conformance {

using bus::Bytes;

/// Bytes and their CRC, high byte first, by chapter 4.2 bit by bit (R15).
Bytes with_crc(Bytes bytes, std::uint16_t error = 0);
Bytes read_telegram(std::uint16_t address, std::uint8_t length, std::uint8_t card = 1);
Bytes write_telegram(std::uint16_t address, const Bytes& data, std::uint8_t card = 1);
/// SPI's read and write; its length byte is the number of inputs.
Bytes inputs_telegram(const Bytes& inputs, std::uint8_t card = 1);
Bytes exchange_telegram(std::uint8_t function, std::uint16_t address, const Bytes& data, std::uint8_t card = 1);

}  // namespace dsdpv1::conformance
