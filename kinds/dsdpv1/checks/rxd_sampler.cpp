#include "kinds/dsdpv1/checks/rxd_sampler.hpp"

#include <bitset>

namespace dsdpv1::checks {
namespace {

constexpr int kStartBit = 0, kFirstData = 1, kStopBit = 10;

bool even(unsigned bits) { return std::bitset<kStopBit>(bits).count() % 2 == 0; }

}  // namespace

void RxdSampler::restart(bool level, Tick idle_since, Tick bit) {
  state_ = level ? State::kIdle : State::kBreak;
  level_ = level;
  bit_ = bit;
  idle_since_ = idle_since;
}

void RxdSampler::restart_with_start_bit(Tick fell, Tick bit) {
  restart(true, edge_seeing(fell), bit);
  change(fell, false);
}

void RxdSampler::change(Tick at, bool level) {
  level_ = level;
  if (state_ == State::kBreak && level) {
    state_ = State::kIdle;
    idle_since_ = edge_seeing(at);
  } else if (state_ == State::kIdle && !level) {
    state_ = State::kReceiving;
    edge_ = edge_seeing(at);
    index_ = kStartBit;
    shift_ = 0;
    character_ = {};
    character_.fell = at;
    character_.idle_since = idle_since_;
  }
}

Tick RxdSampler::sample_tick() const { return (edge_ + bit_ / 2 + index_ * bit_) * kTicksPerCycle; }

std::optional<RxdCharacter> RxdSampler::advance(Tick at) {
  while (receiving() && sample_tick() <= at)
    if (take(level_)) return character_;
  return std::nullopt;
}

/// A pulse that ends before mid-bit is not a start bit: silence continues.
bool RxdSampler::take(bool level) {
  if (index_ == kStartBit && level) {
    state_ = State::kIdle;
    return false;
  }
  if (index_ == kStopBit) {
    character_.stop = sample_tick();
    character_.value = static_cast<std::uint8_t>(shift_ & 0xFFU);
    character_.parity_ok = even(shift_);
    character_.stop_ok = level;
    character_.low = shift_ == 0;
    idle_since_ = edge_ + kBitsPerCharacter * bit_;
    state_ = level ? State::kIdle : State::kBreak;
    return true;
  }
  if (index_ >= kFirstData && level) shift_ |= 1U << static_cast<unsigned>(index_ - kFirstData);
  ++index_;
  return false;
}

}  // namespace dsdpv1::checks
