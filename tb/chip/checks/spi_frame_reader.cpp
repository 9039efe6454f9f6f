#include "tb/chip/checks/spi_frame_reader.hpp"

namespace dsdpv1::tb {

void SpiFrameReader::Wire::set(Tick at, bool to) {
  if (changed != at) earlier = level;
  changed = at;
  level = to;
}

void SpiFrameReader::read(Tick at, SpiWire wire, Level level) {
  pass(at);
  switch (wire) {
    case SpiWire::kXss: return xss(at, level != 0);
    case SpiWire::kSck: return (level != 0) == (mode_ == 0 || mode_ == 3) ? sck_takes(at) : void();
    case SpiWire::kMosi: return mosi_.set(at, level != 0);
    case SpiWire::kMiso: return miso_.set(at, level != 0);  // released: read as high
  }
}

void SpiFrameReader::pass(Tick at) {
  if (!rose_ || *rose_ >= at) return;
  frame_ended(*rose_);
  forget_frame();
}

void SpiFrameReader::forget_frame() {
  fell_.reset();
  rose_.reset();
}

void SpiFrameReader::xss(Tick at, bool level) {
  if (level) {
    if (fell_) rose_ = at;
    return;
  }
  fell_ = at;
  rose_.reset();
  bits_ = 0;
  frame_began(at);
}

void SpiFrameReader::sck_takes(Tick at) {
  const bool selected = fell_ && *fell_ < at && (!rose_ || at <= *rose_);
  if (!selected) return;
  if (bits_ % 8 == 0) byte_start_ = at;
  out_ = (out_ << 1 | (mosi_.before(at) ? 1U : 0U)) & 0xFFU;
  in_ = (in_ << 1 | (miso_.before(at) ? 1U : 0U)) & 0xFFU;
  if (++bits_ % 8 == 0) byte(at, static_cast<std::uint8_t>(out_), static_cast<std::uint8_t>(in_));
}

}  // namespace dsdpv1::tb
