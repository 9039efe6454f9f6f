#include "model/xgate/frame.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

namespace dsdpv1::xgate {
namespace {

constexpr std::uint8_t kErrorSize = 3, kPrintedLength = 0x83;

void put(std::uint8_t command, std::uint8_t length, std::uint8_t special, const std::uint8_t* data, int size,
         Wire& wire) {
  const std::uint8_t head[kFrameHead] = {kFrameStart, command, length, special};
  wire.assign(head, kFrameHead);
  std::copy_n(data, size, wire.bytes.data() + kFrameHead);
  wire.size = kFrameHead + size;
  wire.bytes[static_cast<std::size_t>(wire.size)] = xor_of(wire.bytes.data(), wire.size);
  ++wire.size;
}

}  // namespace

std::uint8_t xor_of(const std::uint8_t* bytes, int size) {
  return std::accumulate(bytes, bytes + size, std::uint8_t{0}, std::bit_xor<std::uint8_t>());
}

void compose(const Frame& frame, Wire& wire) {
  put(frame.command, static_cast<std::uint8_t>(frame.size()), frame.special, frame.data.bytes.data(), frame.size(),
      wire);
}

void compose_error(std::uint8_t command, std::uint8_t special, Error error, ErrorForm form, Wire& wire) {
  const std::uint8_t data[kErrorSize] = {error.type, error.code, 0};
  if (form == ErrorForm::kPrinted) return put(command, kPrintedLength, special, data, kErrorSize, wire);
  put(command, kErrorSize, static_cast<std::uint8_t>(special | kErrorFlag), data, kErrorSize, wire);
}

FrameParser::Got FrameParser::take(std::uint8_t byte) {
  if (place_ == Place::kXor) {
    place_ = Place::kStart;
    return byte == xor_ ? Got::kFrame : Got::kWrongXor;
  }
  if (place_ == Place::kStart) {
    if (byte != kFrameStart) return Got::kNothing;
    xor_ = 0;
  }
  xor_ = static_cast<std::uint8_t>(xor_ ^ byte);
  add(byte);
  return Got::kNothing;
}

void FrameParser::add(std::uint8_t byte) {
  switch (place_) {
    case Place::kCommand: frame_.command = byte; break;
    case Place::kLength:
      length_ = byte;
      frame_.data.size = 0;
      break;
    case Place::kSpecial:
      frame_.special = byte;
      place_ = length_ == 0 ? Place::kXor : Place::kData;
      return;
    case Place::kData:
      frame_.data.bytes[static_cast<std::size_t>(frame_.data.size++)] = byte;
      if (frame_.size() == length_) place_ = Place::kXor;
      return;
    default: break;
  }
  place_ = static_cast<Place>(static_cast<int>(place_) + 1);
}

}  // namespace dsdpv1::xgate
