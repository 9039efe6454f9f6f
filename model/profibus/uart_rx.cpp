#include "model/profibus/uart_rx.hpp"

#include <algorithm>

namespace dsdpv1::profibus {
namespace {

constexpr Cycle kSynchroniser = 2;  // P9: what edge m sampled, the logic uses at edge m+2

bool odd_ones(unsigned bits) { return (__builtin_popcount(bits) & 1) != 0; }

}  // namespace

bool UartRx::set_line(Tick at, bool level) {
  if (level == input_) return false;
  input_ = level;
  note(first_edge_after(at) + kSynchroniser);
  return count_ <= 2;  // later ones do not change next()
}

void UartRx::note(Cycle visible) {
  const unsigned last = (first_ + count_ - 1) % kDepth;
  if (count_ > 0 && edges_[last] == visible)
    --count_;  // two changes between two edges cancel
  else
    edges_[(first_ + count_++) % kDepth] = visible;
}

void UartRx::skip(Cycle now) {
  while (edge() <= now) drop_edge();
}

void UartRx::restart(int bit, Cycle now, Cycle idle_since) {
  leave_run(now * kTicksPerCycle);
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
  if (in_run()) return run_start_ + to_stop();
  if (state_ == State::kReceiving && index_ > 0) return sample_ + Cycle{kStopIndex - index_} * bit_;
  const Cycle start = start_sample();
  return start == kNever ? kNever : start + Cycle{kStopIndex} * bit_;
}

Cycle UartRx::next() const {
  if (in_run() && at_once_) return stop_sample() + Cycle{run_size_ - 1 - run_index_} * kBitsPerCharacter * bit_;
  const Cycle stop = stop_sample();
  if (stop != kNever) return stop;
  return state_ == State::kReceiving ? sample_ : edge();  // it may not be a start bit at all
}

// Once the start bit is valid, only the levels at the sampling points count, and they are evaluated at the last one.
Unheard UartRx::unheard() const {
  const Cycle stop = stop_sample();
  if (stop == kNever || in_run()) return {};
  const bool stands = state_ == State::kReceiving && index_ > 0;
  return {stands ? 0 : (start_sample() - kSynchroniser) * kTicksPerCycle, stop * kTicksPerCycle};
}

// Processes edges and sampling points in order; at one cycle the edge comes first.
bool UartRx::eval(Cycle now) {
  if (in_run()) {
    if (stop_sample() > now) return false;
    take_from_run();
    return true;
  }
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

// --- runs: the effect of the same edges -----------------------------------------------------------------------------

bool UartRx::set_run(const CharacterRun& run, bool at_once) {
  if (state_ != State::kIdle || count_ > 0 || in_run() || run.bit != bit_ || run.size > kLongestRun) return false;
  std::copy_n(run.bytes, run.size, run_.begin());
  run_size_ = run.size;
  run_index_ = 0;
  left_run_ = false;
  at_once_ = at_once;
  run_edge_ = run.start;
  run_start_ = first_edge_after(run.start) + kSynchroniser;
  return true;
}

void UartRx::take_from_run() {
  character_ = {run_start_, run_start_ - idle_since_, run_[static_cast<std::size_t>(run_index_)], true, true};
  pass_characters(1);
}

void UartRx::take_run() {
  pass_characters(run_size_ - 1);
  take_from_run();
}

void UartRx::pass_characters(int count) {
  const Cycle length = Cycle{count} * kBitsPerCharacter * bit_;
  run_start_ += length;
  run_edge_ += length * kTicksPerCycle;
  if (count > 0) idle_since_ = run_start_;
  run_index_ += count;
}

// Inserts the edges up to `at` of the characters that are not complete: one, and the first edge of the next.
void UartRx::leave_run(Tick at) {
  while (in_run() && stop_sample() <= at / kTicksPerCycle) take_from_run();
  left_run_ |= in_run();
  Tick edge = run_edge_;
  for (bool level = true; in_run(); ++run_index_) {
    const unsigned frame = frame_of(run_[static_cast<std::size_t>(run_index_)]);
    for (int i = 0; i < kBitsPerCharacter; ++i, edge += bit_ * kTicksPerCycle) {
      const bool next = ((frame >> i) & 1U) != 0;
      if (edge <= at && next != level) note(first_edge_after(edge) + kSynchroniser);
      if (edge <= at) level = next;
    }
    input_ = level;
  }
}

// --- edges -----------------------------------------------------------------------------------------------------------

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
  if (index_ == 0 && line_) {  // the line is high in the middle of the start bit: a glitch, idle continues (S10)
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

}  // namespace dsdpv1::profibus
