#include "model/profibus/uart_rx.hpp"

namespace profibus {
namespace {

constexpr int kParityIndex = 9;
constexpr int kStopIndex = 10;

bool odd_ones(unsigned bits) { return (__builtin_popcount(bits) & 1) != 0; }

}  // namespace

void UartRx::restart(int bit, Cycle idle_since, bool line) {
  state_ = line ? State::kIdle : State::kBreak;
  line_ = line;
  bit_ = bit;
  idle_since_ = idle_since;
}

bool UartRx::eval(Cycle now, bool line) {
  const bool fell = line_ && !line;
  line_ = line;
  switch (state_) {
    case State::kIdle:
      if (fell) start(now);
      return false;
    case State::kReceiving: return now == sample_ && sample(line);
    case State::kBreak:
      if (line) {
        state_ = State::kIdle;
        idle_since_ = now;
      }
      return false;
  }
  return false;
}

void UartRx::start(Cycle now) {
  state_ = State::kReceiving;
  character_.start = now;
  character_.idle = now - idle_since_;
  index_ = 0;
  shift_ = 0;
  sample_ = now + bit_ / 2;
}

bool UartRx::sample(bool line) {
  sample_ += bit_;
  if (index_ == 0 && line) {  // the start bit is gone at its middle: a glitch, idle goes on (S10)
    state_ = State::kIdle;
    return false;
  }
  if (index_ >= 1 && index_ <= kParityIndex) shift_ |= static_cast<unsigned>(line) << (index_ - 1);
  if (index_++ < kStopIndex) return false;

  character_.value = static_cast<std::uint8_t>(shift_ & 0xFF);
  character_.parity_ok = !odd_ones(shift_);
  character_.stop_ok = line;
  idle_since_ = character_.start + Cycle{kBitsPerCharacter} * bit_;
  state_ = line ? State::kIdle : State::kBreak;
  return true;
}

}  // namespace profibus
