#include "model/profibus/uart_tx.hpp"

namespace dsdpv1::profibus {

void UartTx::send(const std::uint8_t* bytes, int size, int bit, Cycle begin, Cycle lead, Cycle trail) {
  frames_ = bytes_ = bytes;
  size_ = size;
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
  if (now < begin_)
    next_ = begin_;
  else if (now < end_)
    next_run();
  else
    next_ = released();
  return false;
}

// The rest to be sent lies within the bytes.
bool UartTx::is_possible() const {
  if (next_ == kNever) return true;
  if (bytes_ == nullptr || end_ != begin_ + Cycle{size_} * kBitsPerCharacter * bit_) return false;
  const Cycle sent = begin_ + (Cycle{kBitsPerCharacter} * (bytes_ - frames_) - frame_bits_) * bit_;
  return next_ < begin_ ? sent == begin_ : next_ == sent || next_ == released();
}

void UartTx::load() {
  frame_ = frame_of(*bytes_++);
  frame_bits_ = kBitsPerCharacter;
}

}  // namespace dsdpv1::profibus
