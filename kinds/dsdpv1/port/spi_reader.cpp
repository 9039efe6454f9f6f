#include "kinds/dsdpv1/port/spi_reader.hpp"

#include <fmt/format.h>

namespace dsdpv1::tb {
namespace {

using dsdpv1::mask;
using dsdpv1::Pin;
constexpr std::uint8_t kIdle = 0xFF;  // SP6

}  // namespace

PinMask SpiReader::pins() const {
  return mask(Pin::kReset) | mask(Pin::kXss) | mask(Pin::kSck) | mask(Pin::kMosi) | mask(Pin::kMiso);
}

void SpiReader::pin(Tick at, PinNumber pin, Level level) {
  now_ = at;
  const Tick before = next();
  read(at, static_cast<Pin>(pin), level);
  if (static_cast<Pin>(pin) == Pin::kReset && level == 0) forget_frame();
  if (next() != before) announce();
}

void SpiReader::frame_began(Tick /*at*/) {
  request_.clear();
  reply_.clear();
  asked_ = replied_ = false;
}

void SpiReader::byte(Tick at, std::uint8_t mosi, std::uint8_t miso) {
  asked_ ? reply_byte(at, miso) : request_byte(at, mosi);
}

void SpiReader::frame_ended(Tick at) {
  const std::string over = bits() % 8 == 0 ? "" : fmt::format(" and {} bits", bits() % 8);
  if (!request_.empty() && !asked_ && request_.begins())
    tell_request(at, fmt::format("cut after {} bytes{}", request_.bytes().size(), over));
  else if (!request_.empty() && !asked_)
    tell_request(at, "no telegram");
  else if (request_.empty() && bits() != 0)
    tell({byte_start(), at, false, "no byte", {}, fmt::format("cut after {} bits", bits())});
  if (!reply_.empty() && !replied_) tell_reply(at, fmt::format("cut after {} bytes{}", reply_.bytes().size(), over));
}

// --- telegrams -------------------------------------------------------------------------------------------------------

void SpiReader::request_byte(Tick at, std::uint8_t byte) {
  if (request_.empty()) request_start_ = byte_start();
  request_.add(byte);
  asked_ = request_.complete();
  if (asked_) tell_request(at, request_.wrong());
}

/// Bytes of FF may precede and follow it (SP6).
void SpiReader::reply_byte(Tick at, std::uint8_t byte) {
  if (replied_ || (reply_.empty() && byte == kIdle)) return;
  if (reply_.empty()) reply_start_ = byte_start();
  reply_.add(byte);
  replied_ = reply_.complete(request_);
  if (replied_) tell_reply(at, reply_.wrong());
}

void SpiReader::tell_request(Tick end, const std::string& wrong) {
  tell({request_start_, end, false, request_.words(), request_.bytes(), wrong});
}

void SpiReader::tell_reply(Tick end, const std::string& wrong) {
  tell({reply_start_, end, true, reply_.words(request_), reply_.bytes(), wrong});
}

}  // namespace dsdpv1::tb
