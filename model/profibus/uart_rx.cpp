#include "model/profibus/uart_rx.hpp"

#include <algorithm>

namespace profibus {
namespace {

constexpr Cycle kSynchroniser = 2;  // P9: what edge m sampled, the logic uses at edge m+2
constexpr int kStopIndex = 10;

bool odd_ones(unsigned bits) { return (__builtin_popcount(bits) & 1) != 0; }

}  // namespace

bool UartRx::set_line(Tick at, bool level) {
  if (level == input_) return false;
  input_ = level;
  const Cycle visible = first_edge_after(at) + kSynchroniser;
  const unsigned last = (first_ + count_ - 1) % kDepth;
  if (count_ > 0 && edges_[last] == visible)
    --count_;  // there and back between two edges
  else
    edges_[(first_ + count_++) % kDepth] = visible;
  return count_ <= 2;  // nobody looks at more than the first two
}

void UartRx::skip(Cycle now) {
  while (edge() <= now) drop_edge();
}

void UartRx::restart(int bit, Cycle now, Cycle idle_since) {
  skip(now);
  state_ = line_ ? State::kIdle : State::kBreak;
  bit_ = bit;
  idle_since_ = idle_since;
}

Cycle UartRx::start_sample() const {
  const bool begun = state_ == State::kReceiving && !line_, begins = state_ == State::kIdle && count_ > 0;
  if (!begun && !begins) return kNever;
  const Cycle at = begun ? sample_ : edge() + bit_ / 2;
  const Cycle rise = begun ? edge() : second_edge();
  return rise > at ? at : kNever;
}

Cycle UartRx::stop_sample() const {
  if (state_ == State::kReceiving && index_ > 0) return sample_ + Cycle{kStopIndex - index_} * bit_;
  const Cycle start = start_sample();
  return start == kNever ? kNever : start + Cycle{kStopIndex} * bit_;
}

Cycle UartRx::next() const {
  const Cycle stop = stop_sample();
  if (stop != kNever) return stop;
  return state_ == State::kReceiving ? sample_ : edge();  // maybe no start bit, or none at all
}

// Once the start bit stands, all that counts is the level at the sampling points, and that is asked at the last one.
Unheard UartRx::unheard() const {
  const Cycle stop = stop_sample();
  if (stop == kNever) return {};
  const bool stands = state_ == State::kReceiving && index_ > 0;
  return {stands ? 0 : (start_sample() - kSynchroniser) * kTicksPerCycle, stop * kTicksPerCycle};
}

// Edges and sampling points in their order; at one cycle the edge comes first.
bool UartRx::eval(Cycle now) {
  for (;;) {
    const Cycle change = edge();
    if (state_ == State::kReceiving && sample_ < change) {
      if (sample_ > now) return false;
      if (sample(std::min(change, now + 1))) return true;
    } else {
      if (change > now) return false;
      take_edge();
    }
  }
}

void UartRx::take_edge() {
  const Cycle now = edge();
  drop_edge();
  if (state_ == State::kIdle) {
    state_ = State::kReceiving;
    character_.start = now;
    character_.idle = now - idle_since_;
    index_ = 0;
    shift_ = 0;
    sample_ = now + bit_ / 2;
  } else if (state_ == State::kBreak) {
    state_ = State::kIdle;
    idle_since_ = now;
  }
}

// The sampling points before `end`, up to which the line does not change.
bool UartRx::sample(Cycle end) {
  if (index_ == 0 && line_) {  // the start bit is gone at its middle: a glitch, idle goes on (S10)
    state_ = State::kIdle;
    return false;
  }
  for (; index_ < kStopIndex; ++index_, sample_ += bit_) {
    if (sample_ >= end) return false;
    shift_ |= static_cast<unsigned>(line_) << index_;
  }
  if (sample_ >= end) return false;
  character_.value = static_cast<std::uint8_t>(shift_ >> 1);
  character_.parity_ok = !odd_ones(shift_);
  character_.stop_ok = line_;
  idle_since_ = character_.start + Cycle{kBitsPerCharacter} * bit_;
  state_ = line_ ? State::kIdle : State::kBreak;
  return true;
}

}  // namespace profibus
