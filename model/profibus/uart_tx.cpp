#include "model/profibus/uart_tx.hpp"

namespace profibus {

void UartTx::send(const std::uint8_t* bytes, int size, int bit, Cycle begin, Cycle lead, Cycle trail) {
  frames_ = bytes_ = bytes;
  size_ = left_ = size;
  bit_ = bit;
  begin_ = begin;
  end_ = begin + static_cast<Cycle>(size) * kBitsPerCharacter * bit;
  trail_ = trail;
  frame_bits_ = 0;
  next_ = begin - lead;
}

void UartTx::abort() {
  next_ = kNever;
  txd_ = true;
  rts_ = false;
}

CharacterRun UartTx::hide() {
  next_ = released();
  return {begin_ * kTicksPerCycle, bit_, frames_, size_};
}

void UartTx::show(Cycle now) {
  bytes_ = frames_;
  left_ = size_;
  frame_bits_ = 0;
  next_ = begin_;
  while (next_ <= now) eval(next_);
}

bool UartTx::eval(Cycle now) {
  if (now != next_) return false;
  if (now == released()) {
    abort();
    return true;
  }
  rts_ = true;
  if (now < begin_) {
    next_ = begin_;
    return false;
  }
  if (frame_bits_ == 0) load();
  shift();
  return false;
}

void UartTx::load() {
  if (left_ == 0) return;
  frame_ = frame_of(*bytes_++);
  frame_bits_ = kBitsPerCharacter;
  --left_;
}

// Puts the next run of equal bits on the line, so that only level changes and character ends need an evaluation.
void UartTx::shift() {
  if (frame_bits_ == 0) {
    next_ = released();
    return;
  }
  txd_ = (frame_ & 1U) != 0;
  const unsigned other = txd_ ? ~frame_ : frame_;  // its lowest one is the next bit of the other level
  const int run = __builtin_ctz(other | 1U << frame_bits_);
  frame_ >>= run;
  frame_bits_ -= run;
  next_ += static_cast<Cycle>(run) * bit_;
}

}  // namespace profibus
