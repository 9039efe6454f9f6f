#include "board/stm32/timer.hpp"

#include <algorithm>

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kMost = 0xFFFF;
constexpr std::uint32_t kCr2 = 0x04, kSmcr = 0x08, kCcer = 0x20;
constexpr RegisterList kTimerRegisters = {{Timer::kCr1, "CR1", 0, 0x3FF},
                                          {kCr2, "CR2", 0, 0xF8},
                                          {kSmcr, "SMCR", 0, 0xFFF7},
                                          {Timer::kDier, "DIER", 0, 0x5F5F},
                                          {Timer::kSr, "SR"},
                                          {Timer::kEgr, "EGR"},
                                          {0x18, "CCMR1", 0, kMost},
                                          {0x1C, "CCMR2", 0, kMost},
                                          {kCcer, "CCER", 0, 0x3333},
                                          {Timer::kCnt, "CNT", 0, kMost},
                                          {Timer::kPsc, "PSC", 0, kMost},
                                          {Timer::kArr, "ARR", kMost, kMost},
                                          {0x34, "CCR1", 0, kMost},
                                          {0x38, "CCR2", 0, kMost},
                                          {0x3C, "CCR3", 0, kMost},
                                          {0x40, "CCR4", 0, kMost},
                                          {0x48, "DCR", 0, 0x1F1F},
                                          {0x4C, "DMAR", 0, kMost}};
// No capture, compare, DMA, triggers or counting down.
constexpr TagList kTimerTags = {{Timer::kCr1, 4, 1, "DIR"},
                                {Timer::kCr1, 5, 2, "CMS"},
                                {kCr2, 4, 3, "MMS"},
                                {kCr2, 7, 1, "TI1S"},
                                {kSmcr, 0, 3, "SMS"},
                                {kSmcr, 14, 1, "ECE"},
                                {Timer::kDier, 1, 4, "CC[4:1]IE"},
                                {Timer::kDier, 6, 1, "TIE"},
                                {Timer::kDier, 8, 7, "DMA"},
                                {Timer::kEgr, 1, 4, "CC[4:1]G"},
                                {Timer::kEgr, 6, 1, "TG"},
                                {kCcer, 0, 1, "CC1E"},
                                {kCcer, 4, 1, "CC2E"},
                                {kCcer, 8, 1, "CC3E"},
                                {kCcer, 12, 1, "CC4E"}};

}  // namespace

constexpr RegisterTable Timer::kRegisters{kTimerRegisters, kTimerTags};

void Timer::follow(unsigned hclk_cycles, bool clocked, std::uint64_t now) {
  if (divider_ == hclk_cycles && clocked_ == clocked) return;
  catch_up(now);
  rebase(now);
  divider_ = hclk_cycles;
  clocked_ = clocked;
  begin(now);
}

void Timer::reset() {
  const unsigned divider = divider_;
  const bool clocked = clocked_;
  *this = Timer();
  divider_ = divider;
  clocked_ = clocked;
}

std::uint32_t Timer::read(std::uint32_t offset, std::uint64_t now) {
  catch_up(now);
  return offset == kCnt ? count_at(now) : words_.read(offset);
}

std::uint32_t Timer::peek(std::uint32_t offset, std::uint64_t now) const { return Timer(*this).read(offset, now); }

void Timer::write(std::uint32_t offset, std::uint32_t value, std::uint64_t now) {
  catch_up(now);
  switch (offset) {
    case kSr: words_[kSr] &= value; break;  // cleared by writing 0
    case kEgr:
      if ((value & kUg) != 0) generate(now);
      break;
    case kCnt:
      rebase(now);
      words_.write(kCnt, value);
      break;
    case kCr1: {
      rebase(now);
      const bool ran = runs();
      words_.write(kCr1, value);
      if (!ran) begin(now);
      break;
    }
    case kArr: {
      rebase(now);
      const bool ran = runs();
      words_.write(kArr, value);
      if ((words_[kCr1] & kArpe) == 0) limit_ = words_[kArr];
      if (!ran) begin(now);
      break;
    }
    default: words_.write(offset, value);
  }
}

std::uint64_t Timer::next() const {
  const bool will_ask =
      runs() && (words_[kCr1] & kUdis) == 0 && (words_[kDier] & kUif) != 0 && (words_[kSr] & kUif) == 0;
  return will_ask ? overflow_at() : kNever;
}

/// Its first edge comes with the next cycle of the clock.
void Timer::begin(std::uint64_t now) { since_ = (now / divider_ + 1) * divider_; }

std::uint64_t Timer::overflow_at() const {
  const std::uint32_t count = words_[kCnt], last = count <= limit_ ? limit_ : kMost;
  return since_ + (std::uint64_t{last} - count + 1) * step();
}

/// After catch_up(now).
std::uint32_t Timer::count_at(std::uint64_t now) const {
  return words_[kCnt] + (runs() && now > since_ ? static_cast<std::uint32_t>((now - since_) / step()) : 0);
}

/// CNT at `now`; the prescaler goes on.
void Timer::rebase(std::uint64_t now) {
  const std::uint32_t count = count_at(now);
  since_ += (count - words_[kCnt]) * step();
  words_[kCnt] = count;
}

/// After the second overflow the period stays.
void Timer::catch_up(std::uint64_t now) {
  for (int i = 0; i < 2 && runs() && overflow_at() <= now; ++i) overflow();
  if (!runs() || overflow_at() > now) return;
  const std::uint64_t period = overflow_at() - since_;
  since_ += (now - since_) / period * period;
}

void Timer::overflow() {
  since_ = overflow_at();
  words_[kCnt] = 0;
  if ((words_[kCr1] & kUdis) != 0) return;
  update();
  words_[kSr] |= kUif;
  if ((words_[kCr1] & kOpm) != 0) words_[kCr1] &= ~kCen;
}

void Timer::update() {
  prescaler_ = words_[kPsc];
  limit_ = words_[kArr];
}

/// UG: the counter and its prescaler begin again (15.3.2; EGR).
void Timer::generate(std::uint64_t now) {
  words_[kCnt] = 0;
  if ((words_[kCr1] & kUdis) == 0) {
    update();
    if ((words_[kCr1] & kUrs) == 0) words_[kSr] |= kUif;
  }
  begin(now);
}

}  // namespace dsdpv1::arm
