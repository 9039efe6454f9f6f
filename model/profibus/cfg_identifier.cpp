#include "model/profibus/cfg_identifier.hpp"

namespace dsdpv1::profibus {
namespace {

constexpr std::uint8_t kInputBit = 0x10, kOutputBit = 0x20, kWordBit = 0x40;  // compact, table A.3
constexpr std::uint8_t kSpecialInput = 0x40, kSpecialOutput = 0x80;           // special, table A.4
constexpr int kNoManufacturerData = 15;  // EN 50170: 15 = no manufacturer data either

int special_length(std::uint8_t byte) { return ((byte & 0x3F) + 1) * ((byte & kWordBit) != 0 ? 2 : 1); }  // table A.5

}  // namespace

void CfgLengths::add(std::uint8_t byte) {
  switch (state_) {
    case State::kIdentifier:
      if ((byte & (kInputBit | kOutputBit)) != 0)
        compact(byte);
      else
        special(byte);
      return;
    case State::kOutputLength:
      output_ += special_length(byte);
      if (input_follows_)
        state_ = State::kInputLength;
      else
        after_lengths();
      return;
    case State::kInputLength:
      input_ += special_length(byte);
      after_lengths();
      return;
    case State::kManufacturer:
      if (--manufacturer_ == 0) state_ = State::kIdentifier;
      return;
  }
}

void CfgLengths::compact(std::uint8_t byte) {
  const int length = ((byte & 0x0F) + 1) * ((byte & kWordBit) != 0 ? 2 : 1);
  if ((byte & kInputBit) != 0) input_ += length;
  if ((byte & kOutputBit) != 0) output_ += length;
}

void CfgLengths::special(std::uint8_t byte) {
  manufacturer_ = (byte & 0x0F) == kNoManufacturerData ? 0 : byte & 0x0F;
  input_follows_ = (byte & kSpecialInput) != 0;
  if ((byte & kSpecialOutput) != 0)
    state_ = State::kOutputLength;
  else if (input_follows_)
    state_ = State::kInputLength;
  else
    after_lengths();
}

void CfgLengths::after_lengths() { state_ = manufacturer_ > 0 ? State::kManufacturer : State::kIdentifier; }

CfgLengths cfg_lengths(const std::uint8_t* bytes, int size) {
  CfgLengths lengths;
  for (int i = 0; i < size; ++i) lengths.add(bytes[i]);
  return lengths;
}

}  // namespace dsdpv1::profibus
