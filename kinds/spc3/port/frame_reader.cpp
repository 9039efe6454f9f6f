#include "kinds/spc3/port/frame_reader.hpp"

#include <algorithm>

namespace dsdpv1::tb {

using spc3_bus::SpiFrame;

namespace {

bus::Bytes head_of(const bus::Bytes& bytes, std::size_t size) {
  return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(std::min(size, bytes.size()))};
}

}  // namespace

PinMask Spc3FrameReader::pins() const {
  using spc3::mask;
  using spc3::Pin;
  return mask(Pin::kReset) | mask(Pin::kSerial) | mask(Pin::kSck) | mask(Pin::kMosi) | mask(Pin::kXss) |
         mask(Pin::kMiso);
}

void Spc3FrameReader::pin(bus::Tick at, PinNumber pin, Level level) {
  now_ = at;
  const bus::Tick before = next();
  reader_.pin(at, pin, level);
  if (next() != before) announce();
}

void Spc3FrameReader::frame_ended(const SpiFrame& frame) {
  if (frame.out.empty() && frame.bits == 0) return;
  const bool reads = frame.is_known() && frame.is_read();
  tell({frame.began, frame.ended, false, words_of(frame),
        head_of(frame.out, reads ? SpiFrame::kHead : frame.out.size()), wrong_with(frame)});
  if (!reads || frame.data() == 0) return;
  tell({frame.began, frame.ended, true, "answer", {frame.in.begin() + SpiFrame::kHead, frame.in.end()}, ""});
}

}  // namespace dsdpv1::tb
