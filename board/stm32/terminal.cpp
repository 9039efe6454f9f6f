#include "board/stm32/terminal.hpp"

#include "board/stm32/usart.hpp"

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kDr = 0x04, kCr1 = 0x0C, kCr2 = 0x10, kCr3 = 0x14;
constexpr std::uint32_t kUsartAndTransmitterOn = 1U << 13U | 1U << 3U;
constexpr std::size_t kLongestLine = 200;

// Nothing is received, and no interrupt is requested.
constexpr TagList kTags = {
    {kCr1, 0, 1, "SBK"},    {kCr1, 2, 1, "RE"},    {kCr1, 4, 1, "IDLEIE"}, {kCr1, 5, 1, "RXNEIE"},
    {kCr1, 6, 1, "TCIE"},   {kCr1, 7, 1, "TXEIE"}, {kCr1, 8, 1, "PEIE"},   {kCr2, 11, 1, "CLKEN"},
    {kCr2, 14, 1, "LINEN"}, {kCr3, 1, 1, "IREN"},  {kCr3, 3, 1, "HDSEL"},  {kCr3, 5, 1, "SCEN"},
    {kCr3, 6, 1, "DMAR"},   {kCr3, 7, 1, "DMAT"},  {kCr3, 9, 1, "CTSE"},   {kCr3, 10, 1, "CTSIE"}};

}  // namespace

constexpr RegisterTable Terminal::kRegisters{kUsartRegisters, kTags};

void Terminal::write(std::uint32_t offset, std::uint32_t value) {
  words_.write(offset, value);
  const bool on = (words_[kCr1] & kUsartAndTransmitterOn) == kUsartAndTransmitterOn;
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
