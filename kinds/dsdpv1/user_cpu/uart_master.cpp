#include "kinds/dsdpv1/user_cpu/uart_master.hpp"

#include <algorithm>
#include <utility>

#include "bus/wire/character_run.hpp"

namespace dsdpv1::user_cpu {
namespace {

constexpr std::size_t kCells = 11, kParity = 9;

}  // namespace

// -------------------------------------------------------------------------------------------------------------- sender

void UartSender::begin(Tick at, std::vector<std::uint8_t> bytes, const UartFault& fault) {
  if (fault.cut_after) bytes.resize(std::min(bytes.size(), *fault.cut_after));
  if (const auto bit = fault.flipped_bit; bit && *bit / 8 < bytes.size())
    bytes[*bit / 8] = static_cast<std::uint8_t>(bytes[*bit / 8] ^ 1U << *bit % 8);
  if (fault.break_at) bytes.resize(std::min(bytes.size(), *fault.break_at + 1));
  UartFaults faults = static_cast<const UartFaults&>(fault);
  if (fault.talk_over) {
    faults.pause_before = bytes.size();
    faults.pause = *fault.talk_over;
    bytes.push_back(0xFF);
  }
  send(at, std::move(bytes), faults);
}

void PinUartSender::send(Tick at, std::vector<std::uint8_t> bytes, const UartFaults& faults) {
  begin_ = at;
  telegram_ = UartTelegram(std::move(bytes), timing_, faults);
  edge_ = 0;
}

void PinUartSender::run(Tick now) {
  const bool level = telegram_[edge_++].level;
  if (level != level_) pins_.set_serial(now, dsdpv1::Pin::kRxd, level);
  level_ = level;
}

std::unique_ptr<UartSender> SerialPins::make_uart_sender(const UartTiming& timing) {
  return std::make_unique<PinUartSender>(*this, timing);
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

/// Collects the characters whose stop bit's middle is before `now`.
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
