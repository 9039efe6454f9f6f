#include "board/stm32/terminal.hpp"

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kSr = 0x00, kDr = 0x04, kCr1 = 0x0C;
constexpr std::uint32_t kTxeAndTc = 0xC0;
constexpr std::uint32_t kUsartAndTransmitterOn = 1U << 13U | 1U << 3U;
constexpr std::size_t kLongestLine = 200;

}  // namespace

std::uint32_t Terminal::read(std::uint32_t offset) const {
  if (offset == kSr) return kTxeAndTc;
  return offset == kDr || offset / 4 >= kWords ? 0 : words_.at(offset / 4);
}

void Terminal::write(std::uint32_t offset, std::uint32_t value) {
  if (offset / 4 >= kWords) return;
  words_.at(offset / 4) = value;
  const bool on = (words_.at(kCr1 / 4) & kUsartAndTransmitterOn) == kUsartAndTransmitterOn;
  if (offset == kDr && on) send(static_cast<char>(value & 0x7FU));
}

void Terminal::send(char character) {
  if (character == '\r') return;
  if (character != '\n') line_ += character >= ' ' && character != 0x7F ? character : '.';
  if (character != '\n' && line_.size() < kLongestLine) return;
  if (on_line) on_line(line_);
  line_.clear();
}

}  // namespace dsdpv1::arm
