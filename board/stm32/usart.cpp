#include "board/stm32/usart.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kIdleIe = 1U << 4U, kRxneIe = 1U << 5U, kTcIe = 1U << 6U, kTxeIe = 1U << 7U, kPeIe = 1U << 8U;
constexpr std::uint32_t kEie = 1U << 0U;
constexpr unsigned kFirstSample = 8, kLastSample = 10;  // of 16 a bit: the three that vote

constexpr TagList kTags = {{Usart::kCr1, 0, 1, "SBK"},    {Usart::kCr1, 1, 1, "RWU"},   {Usart::kCr2, 11, 1, "CLKEN"},
                           {Usart::kCr2, 14, 1, "LINEN"}, {Usart::kCr3, 1, 1, "IREN"},  {Usart::kCr3, 3, 1, "HDSEL"},
                           {Usart::kCr3, 5, 1, "SCEN"},   {Usart::kCr3, 6, 1, "DMAR"},  {Usart::kCr3, 7, 1, "DMAT"},
                           {Usart::kCr3, 9, 1, "CTSE"},   {Usart::kCr3, 10, 1, "CTSIE"}};

}  // namespace

constexpr RegisterTable Usart::kRegisters{kUsartRegisters, kTags};

// ---------------------------------------------------------------------------------------------------------- registers

std::uint32_t Usart::read(std::uint32_t offset) {
  const std::uint32_t value = peek(offset);
  if (offset == kSr) seen_ = value;
  if (offset == kDr) {
    words_[kSr] &= ~(kRxne | (seen_ & (kPe | kFe | kNe | kOre | kIdle)));
    seen_ &= kTc;
  }
  return value;
}

void Usart::write(std::uint32_t offset, std::uint32_t value, std::uint64_t now) {
  switch (offset) {
    case kSr: words_[kSr] &= value | ~(kRxne | kTc); return;  // the others cannot be written
    case kDr:
      tdr_ = value & 0x1FFU;
      words_[kSr] &= ~(kTxe | (seen_ & (kTc | kPe)));
      seen_ = 0;
      return begin_soon(now);
    case kCr1: return write_control(value, now);
    default: words_.write(offset, value); return begin_soon(now);
  }
}

void Usart::reset() {
  const unsigned divider = divider_;
  const bool rx = rx_;
  const std::uint64_t lost = lost_;
  *this = Usart();
  divider_ = divider;
  lost_ = lost;
  rx_ = before_ = rx;
}

/// TE begins with an idle frame; RE listens from here on.
void Usart::write_control(std::uint32_t value, std::uint64_t now) {
  const std::uint32_t turned_on = value & ~words_[kCr1];
  words_.write(kCr1, value);
  if ((turned_on & (kUe | kTe)) != 0) tx_free_ = pclk_after(now) + frame();
  if ((words_[kCr1] & kUe) == 0 || ((words_[kCr1] & kTe) == 0 && !sends())) {
    cell_ = 0;
    tx_at_ = kNever;
    tx_ = true;
  }
  if (!listens()) {
    start_ = idle_at_ = kNever;
    started_ = false;
    forget_until(kNever);
  }
  begin_soon(now);
}

void Usart::begin_soon(std::uint64_t now) {
  const bool waits = (words_[kCr1] & (kUe | kTe)) == (kUe | kTe) && words_[kBrr] != 0 && (words_[kSr] & kTxe) == 0;
  if (waits && tx_at_ == kNever) tx_at_ = std::max(pclk_after(now), tx_free_);
}

bool Usart::asks() const {
  const auto stands = [this](std::uint32_t enable, std::uint32_t flags) {
    return (words_[kCr1] & enable) != 0 && (words_[kSr] & flags) != 0;
  };
  const bool dma_error =
      (words_[kCr3] & kEie) != 0 && (words_[kCr3] & 1U << 6U) != 0 && (words_[kSr] & (kFe | kNe | kOre)) != 0;
  return stands(kTxeIe, kTxe) || stands(kTcIe, kTc) || stands(kRxneIe, kRxne | kOre) || stands(kIdleIe, kIdle) ||
         stands(kPeIe, kPe) || dma_error;
}

unsigned Usart::half_stops() const {
  static constexpr std::array<unsigned, 4> kHalves = {2, 1, 4, 3};  // STOP: 1, 0.5, 2, 1.5
  return kHalves.at(words_[kCr2] >> 12U & 3U);
}

bool Usart::parity_of(unsigned data) const {
  bool odd = false;
  for (; data != 0; data &= data - 1) odd = !odd;
  return odd != ((words_[kCr1] & kPs) != 0);
}

std::uint64_t Usart::next() const {
  const std::uint64_t rx = start_ == kNever ? kNever : sample_at(started_ ? word_end() : 0, kLastSample);
  return std::min({tx_at_, rx, idle_at_});
}

void Usart::run() {
  const std::uint64_t now = next();
  if (tx_at_ == now) send_cell();
  if (idle_at_ == now) {
    idle_at_ = kNever;
    words_[kSr] |= kIdle;
  }
  if (start_ == kNever || sample_at(started_ ? word_end() : 0, kLastSample) != now) return;
  if (started_)
    take_character();
  else
    check_start();
}

// -------------------------------------------------------------------------------------------------------- transmitter

/// TDR to the shift register: TXE.
void Usart::load() {
  const unsigned data = tdr_ & data_mask();
  out_ = (words_[kCr1] & kPce) != 0 ? data | static_cast<unsigned>(parity_of(data)) << (word_end() - 2) : data;
  words_[kSr] |= kTxe;
  frame_begin_ = tx_at_;
  tx_ = false;
  cell_ = 1;
  tx_at_ = frame_begin_ + bit();
}

void Usart::send_cell() {
  if (!sends()) return load();
  if (cell_ < word_end()) {
    tx_ = (out_ >> (cell_ - 1) & 1U) != 0;
    ++cell_;
    tx_at_ = frame_begin_ + cell_ * bit();
  } else if (cell_ == word_end()) {
    tx_ = true;
    ++cell_;
    tx_at_ = frame_begin_ + frame();
  } else if ((words_[kSr] & kTxe) == 0 && (words_[kCr1] & kTe) != 0) {
    load();
  } else {
    cell_ = 0;
    tx_at_ = kNever;
    words_[kSr] |= kTc;
  }
}

// ----------------------------------------------------------------------------------------------------------- receiver

void Usart::rx_changed(std::uint64_t at, bool level) {
  rx_ = level;
  edges_.push_back({at, level});
  if (!listens()) return forget_until(kNever);
  if (start_ == kNever) hunt();
}

std::uint64_t Usart::sample_at(unsigned bit_number, unsigned sample) const {
  return start_ + (16 * bit_number + sample) * bit() / 16;
}

/// As the cycle's beginning finds it.
bool Usart::level_at(std::uint64_t cycle) const {
  bool level = before_;
  for (const Edge& edge : edges_)
    if (edge.at <= cycle) level = edge.level;
  return level;
}

bool Usart::vote(unsigned bit_number) {
  unsigned high = 0;
  for (unsigned sample = kFirstSample; sample <= kLastSample; ++sample)
    high += static_cast<unsigned>(level_at(sample_at(bit_number, sample)));
  noise_ = noise_ || (high != 0 && high != 3);
  return high >= 2;
}

/// The first fall after a high is the next character's begin.
void Usart::hunt() {
  bool level = before_;
  for (const Edge& edge : edges_) {
    if (level && !edge.level && words_[kBrr] != 0) {
      start_ = pclk_after(edge.at - 1);
      started_ = noise_ = false;
      idle_at_ = kNever;
      return;
    }
    level = edge.level;
  }
}

void Usart::check_start() {
  if (!vote(0)) {
    started_ = true;
    return;
  }
  const std::uint64_t now = sample_at(0, kLastSample);
  start_ = kNever;
  forget_until(now);
  hunt();
}

void Usart::take_character() {
  unsigned word = 0;
  for (unsigned i = 1; i < word_end(); ++i) word |= static_cast<unsigned>(vote(i)) << (i - 1);
  const bool framing = !vote(word_end());
  receive(word, framing, noise_);
  const std::uint64_t now = sample_at(word_end(), kLastSample);
  idle_at_ = framing ? kNever : start_ + 2 * frame();
  start_ = kNever;
  started_ = false;
  forget_until(now);
  hunt();
}

/// With the stop bit's last sample. A character that comes while RXNE is set is lost; DR keeps the one before (ORE).
void Usart::receive(unsigned word, bool framing, bool noise) {
  if ((words_[kSr] & kRxne) != 0) {
    words_[kSr] |= kOre;
    ++lost_;
    return;
  }
  const bool parity = (words_[kCr1] & kPce) != 0 && parity_of(word & data_mask()) != (word >> (word_end() - 2) != 0);
  words_[kDr] = word;
  words_[kSr] |= kRxne | (parity ? kPe : 0) | (framing ? kFe : 0) | (noise ? kNe : 0);
}

void Usart::forget_until(std::uint64_t cycle) {
  for (; !edges_.empty() && edges_.front().at <= cycle; edges_.pop_front()) before_ = edges_.front().level;
}

}  // namespace dsdpv1::arm
