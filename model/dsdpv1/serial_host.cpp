#include "model/dsdpv1/serial_host.hpp"

#include <algorithm>
#include <utility>

#include "model/profibus/character_run.hpp"

namespace dsdpv1 {

// ----------------------------------------------------------------------------------------------------------------- SPI

// XSS falls with the first bit; four edges per bit: MISO sampled, SCK rises, SCK falls, next bit of MOSI; XSS rises.
SpiFrame::SpiFrame(std::vector<std::uint8_t> out, const SpiTiming& timing, std::optional<std::size_t> bits)
    : timing_(timing),
      out_(std::move(out)),
      in_(out_.size(), 0xFF),
      bits_(std::min(8 * out_.size(), bits.value_or(8 * out_.size()))),
      size_(4 * bits_ + 3) {}

Tick SpiFrame::rise(std::size_t bit) const {
  const auto number = static_cast<Tick>(bit);
  return timing_.lead + number * (timing_.high + timing_.low) + number / 8 * timing_.byte_gap;
}

bool SpiFrame::mosi(std::size_t bit) const {
  return bit < 8 * out_.size() && (out_[bit / 8] >> (7 - bit % 8) & 1) != 0;
}

SerialEdge SpiFrame::operator[](std::size_t number) const {
  if (number == 0) return {0, Pin::kXss, false};
  if (number == 1) return {std::min(timing_.mosi_delay, timing_.lead), Pin::kMosi, mosi(0)};
  if (number == size_ - 1)
    return {bits_ == 0 ? timing_.lead : rise(bits_ - 1) + timing_.high + timing_.lag, Pin::kXss, true};
  const std::size_t bit = (number - 2) / 4, part = (number - 2) % 4;
  if ((timing_.mode & 1U) != 0) return late_edge(bit, part);
  const bool rest = (timing_.mode & 2U) != 0;
  switch (part) {
    case 0: return {rise(bit), Pin::kMiso, true};
    case 1: return {rise(bit), Pin::kSck, !rest};
    case 2: return {rise(bit) + timing_.high, Pin::kSck, rest};
    default: return {rise(bit) + timing_.high + mosi_delay(bit), Pin::kMosi, mosi(bit + 1)};
  }
}

SerialEdge SpiFrame::late_edge(std::size_t bit, std::size_t part) const {
  const bool rest = (timing_.mode & 2U) != 0;
  switch (part) {
    case 0: return {rise(bit), Pin::kSck, !rest};
    case 1: return {rise(bit) + std::min(timing_.mosi_delay, timing_.high), Pin::kMosi, mosi(bit)};
    case 2: return {rise(bit) + timing_.high, Pin::kMiso, true};
    default: return {rise(bit) + timing_.high, Pin::kSck, rest};
  }
}

Tick SpiFrame::mosi_delay(std::size_t bit) const {
  return bit + 1 < bits_ ? timing_.mosi_delay : std::min(timing_.mosi_delay, timing_.lag);
}

void SpiFrame::sampled(bool miso) {
  const auto mask = static_cast<std::uint8_t>(0x80U >> sampled_ % 8);
  std::uint8_t& byte = in_[sampled_++ / 8];
  byte = static_cast<std::uint8_t>(miso ? byte | mask : byte & ~mask);
}

// ---------------------------------------------------------------------------------------------------------------- UART

Tick half_bits(const UartTiming& timing, std::int64_t count) {
  constexpr std::int64_t kTicksPerSecond = 1'000'000'000 * profibus::kTicksPerNs;
  return (count * kTicksPerSecond + timing.baud) / (2 * timing.baud);
}

Tick UartTelegram::tick_of(std::size_t bit) const {
  const std::size_t bits = timing_.bits();
  const std::size_t behind = (bit - (bit == bits * bytes_.size() ? 1 : 0)) / bits;  // the end belongs to the last one
  return half_bits(timing_, 2 * static_cast<std::int64_t>(bit)) + static_cast<Tick>(behind) * timing_.gap +
         (behind >= faults_.pause_before.value_or(bytes_.size()) ? faults_.pause : 0);
}

bool UartTelegram::level_of(std::size_t bit) const {
  constexpr std::size_t kParity = 9;
  const std::size_t number = bit / timing_.bits(), place = bit % timing_.bits();
  if (number >= bytes_.size()) return true;
  if (number == faults_.break_at) return false;
  if (!timing_.parity && place == kParity) return true;
  const bool right = (profibus::frame_of(bytes_[number]) >> place & 1U) != 0;
  return right != (place == kParity && faults_.wrong_parity == number);
}

}  // namespace dsdpv1
