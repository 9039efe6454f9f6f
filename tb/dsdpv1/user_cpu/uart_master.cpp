#include "tb/dsdpv1/user_cpu/uart_master.hpp"

#include <algorithm>
#include <utility>

#include "bus/wire/character_run.hpp"

namespace dsdpv1::user_cpu {
namespace {

constexpr std::size_t kCells = 11, kParity = 9;

/// Half bits from the begin of a character to ticks.
Tick half_bits(const UartTiming& timing, std::int64_t count) {
  return (count * bus::kTicksPerSecond + timing.baud) / (2 * timing.baud);
}

}  // namespace

// -------------------------------------------------------------------------------------------------------------- sender

void UartSender::begin(Tick at, std::vector<std::uint8_t> bytes, const UartFault& fault) {
  begin_ = at;
  bytes_ = std::move(bytes);
  if (fault.cut_after) bytes_.resize(std::min(bytes_.size(), *fault.cut_after));
  if (fault.flipped_bit && *fault.flipped_bit / 8 < bytes_.size())
    bytes_[*fault.flipped_bit / 8] =
        static_cast<std::uint8_t>(bytes_[*fault.flipped_bit / 8] ^ 1U << *fault.flipped_bit % 8);
  wrong_parity_ = fault.wrong_parity;
  break_at_ = fault.break_at;
  if (break_at_) bytes_.resize(std::min(bytes_.size(), *break_at_ + 1));
  pause_before_ = fault.pause_before.value_or(bytes_.size());
  pause_ = fault.pause;
  if (fault.talk_over) {
    pause_before_ = bytes_.size();
    pause_ = *fault.talk_over;
    bytes_.push_back(0xFF);
  }
  cell_ = 0;
}

Tick UartSender::tick_of(std::size_t cell) const {
  const auto number = static_cast<std::int64_t>(cell);
  const std::size_t character = (cell - (cell == kCells * bytes_.size() ? 1 : 0)) / kCells;
  return begin_ + half_bits(timing_, 2 * number) + static_cast<Tick>(character) * timing_.gap +
         (character >= pause_before_ ? pause_ : 0);
}

bool UartSender::level_of(std::size_t cell) const {
  const std::size_t number = cell / kCells, bit = cell % kCells;
  if (number >= bytes_.size()) return true;
  if (number == break_at_) return false;
  const bool right = (bus::frame_of(bytes_[number]) >> bit & 1) != 0;
  return right != (bit == kParity && wrong_parity_ == number);
}

void UartSender::run(Tick now) {
  const bool level = level_of(cell_++);
  if (level != level_) pins_.set_serial(now, SerialPin::kRxd, level);
  level_ = level;
}

// ------------------------------------------------------------------------------------------------------------ receiver

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

/// Characters whose stop bit's middle is before `now` have come.
void UartReceiver::hear(Tick now) {
  while (!edges_.empty() && sample_tick(kCells - 1) <= now) take_character();
}

void UartReceiver::take_character() {
  const Tick end = sample_tick(kCells - 1);
  unsigned value = 0;
  for (int bit = 0; bit < 8; ++bit)
    value |= static_cast<unsigned>(level_at(sample_tick(bit + 1))) << static_cast<unsigned>(bit);
  const bool right = level_at(end) &&
                     level_at(sample_tick(kParity)) == bus::even_parity(static_cast<std::uint8_t>(value)) &&
                     !level_at(sample_tick(0));
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
  return edges_.empty() ? over : std::min(over, sample_tick(kCells - 1));
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
