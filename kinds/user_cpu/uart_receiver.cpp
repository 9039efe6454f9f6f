#include "kinds/user_cpu/uart_receiver.hpp"

#include <algorithm>

#include "bus/wire/character_run.hpp"

namespace dsdpv1::user_cpu {
namespace {

constexpr int kParity = 9;

}  // namespace

void UartReceiver::begin(Tick at, std::size_t n, Tick timeout) {
  n_ = n;
  timeout_ = timeout;
  since_ = at;
  bytes_.clear();
  done_ = false;
}

void UartReceiver::txd_changed(Tick at, bool level) {
  hear(at);
  if (edges_.empty() && level) return;
  edges_.push_back({at, level});
}

Tick UartReceiver::sample_tick(int bit) const { return edges_.front().at + half_bits(timing_, 2 * bit + 1); }

bool UartReceiver::level_at(Tick at) const {
  bool level = true;
  for (const Edge& edge : edges_)
    if (edge.at <= at) level = edge.level;
  return level;
}

/// Collects the characters whose stop bit's middle is before `now`.
void UartReceiver::hear(Tick now) {
  while (!edges_.empty() && sample_tick(stop_bit()) <= now) take_character();
}

void UartReceiver::take_character() {
  const Tick end = sample_tick(stop_bit());
  unsigned value = 0;
  for (int bit = 0; bit < 8; ++bit)
    value |= static_cast<unsigned>(level_at(sample_tick(bit + 1))) << static_cast<unsigned>(bit);
  const bool parity_right =
      !timing_.parity || level_at(sample_tick(kParity)) == bus::even_parity(static_cast<std::uint8_t>(value));
  const bool right = level_at(end) && parity_right && !level_at(sample_tick(0));
  if (right)
    characters_.push_back({end, static_cast<std::uint8_t>(value)});
  else
    ++errors_;
  while (!edges_.empty() && (edges_.front().at <= end || edges_.front().level)) edges_.pop_front();
}

Tick UartReceiver::next() const {
  if (done_) return bus::kNever;
  if (!characters_.empty()) return std::max(since_, characters_.front().at);
  const Tick over = since_ + timeout_;
  return edges_.empty() ? over : std::min(over, sample_tick(stop_bit()));
}

void UartReceiver::take(Tick now) {
  while (bytes_.size() < n_ && !characters_.empty() && characters_.front().at <= now) {
    bytes_.push_back(characters_.front().value);
    since_ = std::max(since_, characters_.front().at);
    characters_.pop_front();
  }
}

void UartReceiver::run(Tick now) {
  hear(now);
  take(now);
  done_ = bytes_.size() >= n_ || now >= since_ + timeout_;
}

}  // namespace dsdpv1::user_cpu
