#include "kinds/dsdpv1/port/spi_reader.hpp"

#include <fmt/format.h>

namespace dsdpv1::tb {
namespace {

using dsdpv1::mask;
using dsdpv1::Pin;
constexpr std::uint8_t kIdle = 0xFF;  // SP6

}  // namespace

void SpiReader::Wire::set(Tick at, bool to) {
  if (changed != at) earlier = level;
  changed = at;
  level = to;
}

PinMask SpiReader::pins() const {
  return mask(Pin::kReset) | mask(Pin::kXss) | mask(Pin::kSck) | mask(Pin::kMosi) | mask(Pin::kMiso);
}

void SpiReader::pin(Tick at, PinNumber pin, Level level) {
  now_ = at;
  end_frame_before(at);
  switch (static_cast<Pin>(pin)) {
    case Pin::kReset:
      if (level == 0) fell_.reset(), rose_.reset();
      break;
    case Pin::kXss: xss(at, level != 0); break;
    case Pin::kSck:
      if (level != 0) sck_rose(at);
      return;
    case Pin::kMosi: return mosi_.set(at, level != 0);
    case Pin::kMiso: return miso_.set(at, level != 0);  // released: as high
    default: return;
  }
  announce();
}

// --- frames ----------------------------------------------------------------------------------------------------------

void SpiReader::xss(Tick at, bool level) {
  if (level) {
    if (fell_) rose_ = at;
    return;
  }
  fell_ = at;
  bits_ = 0;
  request_.clear();
  reply_.clear();
  asked_ = replied_ = false;
}

void SpiReader::end_frame_before(Tick at) {
  if (rose_ && *rose_ < at) end_frame();
}

void SpiReader::end_frame() {
  const Tick end = *rose_;
  fell_.reset();
  rose_.reset();
  const std::string bits = bits_ % 8 == 0 ? "" : fmt::format(" and {} bits", bits_ % 8);
  if (!request_.empty() && !asked_ && request_.begins())
    tell_request(end, fmt::format("cut after {} bytes{}", request_.bytes().size(), bits));
  else if (!request_.empty() && !asked_)
    tell_request(end, "no telegram");
  else if (request_.empty() && bits_ != 0)
    tell({byte_start_, end, false, "no byte", {}, fmt::format("cut after {} bits", bits_)});
  if (!reply_.empty() && !replied_) tell_reply(end, fmt::format("cut after {} bytes{}", reply_.bytes().size(), bits));
}

void SpiReader::sck_rose(Tick at) {
  const bool selected = fell_ && *fell_ < at && (!rose_ || at <= *rose_);
  if (!selected) return;
  if (bits_ % 8 == 0) byte_start_ = at;
  out_ = (out_ << 1 | (mosi_.before(at) ? 1U : 0U)) & 0xFFU;
  in_ = (in_ << 1 | (miso_.before(at) ? 1U : 0U)) & 0xFFU;
  if (++bits_ % 8 != 0) return;
  asked_ ? reply_byte(at, static_cast<std::uint8_t>(in_)) : request_byte(at, static_cast<std::uint8_t>(out_));
}

// --- telegrams -------------------------------------------------------------------------------------------------------

void SpiReader::request_byte(Tick at, std::uint8_t byte) {
  if (request_.empty()) request_start_ = byte_start_;
  request_.add(byte);
  asked_ = request_.complete();
  if (asked_) tell_request(at, request_.wrong());
}

/// Bytes of FF may come before it and after it (SP6).
void SpiReader::reply_byte(Tick at, std::uint8_t byte) {
  if (replied_ || (reply_.empty() && byte == kIdle)) return;
  if (reply_.empty()) reply_start_ = byte_start_;
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
