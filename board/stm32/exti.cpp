#include "board/stm32/exti.hpp"

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kImr = 0x00, kEmr = 0x04, kRtsr = 0x08, kFtsr = 0x0C, kSwier = 0x10, kPr = 0x14;
constexpr std::uint32_t kEvcr = 0x00, kMapr = 0x04, kExticr1 = 0x08, kExticr4 = 0x14;
constexpr std::uint32_t kLines = 0x7'FFFF;  // 19 lines; only 0 to 15 are pins
constexpr std::uint32_t kLines5To9 = 0x03E0, kLines10To15 = 0xFC00;

}  // namespace

std::uint32_t Exti::read(std::uint32_t offset) const {
  switch (offset) {
    case kImr: return imr_;
    case kEmr: return emr_;
    case kRtsr: return rtsr_;
    case kFtsr: return ftsr_;
    case kSwier: return swier_;
    case kPr: return pr_;
    default: return 0;
  }
}

void Exti::write(std::uint32_t offset, std::uint32_t value) {
  value &= kLines;
  switch (offset) {
    case kImr: imr_ = value; break;
    case kEmr: emr_ = value; break;
    case kRtsr: rtsr_ = value; break;
    case kFtsr: ftsr_ = value; break;
    case kSwier:
      request(value & ~swier_);
      swier_ |= value;
      break;
    case kPr:  // cleared by writing 1
      pr_ &= ~value;
      swier_ &= ~value;
      break;
    default: break;
  }
}

std::uint32_t Exti::read_afio(std::uint32_t offset) const {
  if (offset >= kExticr1 && offset <= kExticr4) return exticr_.at((offset - kExticr1) / 4);
  return offset == kMapr ? mapr_ : offset == kEvcr ? evcr_ : 0;
}

void Exti::write_afio(std::uint32_t offset, std::uint32_t value) {
  if (offset >= kExticr1 && offset <= kExticr4) exticr_.at((offset - kExticr1) / 4) = value & 0xFFFFU;
  if (offset == kMapr) mapr_ = value;
  if (offset == kEvcr) evcr_ = value;
}

void Exti::edge(unsigned port, unsigned line, bool level) {
  if (port_of(line) == port && ((level ? rtsr_ : ftsr_) >> line & 1U) != 0) request(1U << line);
}

/// PR also of masked lines, an event of those that EMR lets through.
void Exti::request(std::uint32_t lines) {
  pr_ |= lines;
  event_ = event_ || (lines & emr_) != 0;
}

bool Exti::listens(unsigned port) const {
  for (unsigned line = 0; line < 16; ++line)
    if (port_of(line) == port && ((rtsr_ | ftsr_) >> line & 1U) != 0) return true;
  return false;
}

unsigned Exti::requests() const {
  const std::uint32_t asked = pr_ & imr_;
  return (asked & 0x1FU) | static_cast<unsigned>((asked & kLines5To9) != 0) << 5U |
         static_cast<unsigned>((asked & kLines10To15) != 0) << 6U;
}

}  // namespace dsdpv1::arm
