#include "bus/wire/character_run.hpp"

namespace dsdpv1::bus {
namespace {

constexpr unsigned kParityBit = 1U << 9;
constexpr unsigned kStopBit = 1U << 10;

}  // namespace

bool even_parity(std::uint8_t byte) {
  byte = static_cast<std::uint8_t>(byte ^ (byte >> 4));
  byte = static_cast<std::uint8_t>(byte ^ (byte >> 2));
  byte = static_cast<std::uint8_t>(byte ^ (byte >> 1));
  return (byte & 1U) != 0;
}

std::uint16_t frame_of(std::uint8_t byte) {
  return static_cast<std::uint16_t>((byte << 1) | (even_parity(byte) ? kParityBit : 0U) | kStopBit);
}

bool CharacterRun::level(Tick at) const {
  const auto index = static_cast<std::size_t>((at - start) / (kCharacterBits * bit));
  return index >= size || ((frame_of(bytes[index]) >> ((at - character(index)) / bit)) & 1U) != 0;
}

}  // namespace dsdpv1::bus
