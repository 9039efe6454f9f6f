#include "tb/dsdpv1/user_cpu/spi_master.hpp"

#include <algorithm>
#include <utility>

namespace dsdpv1::user_cpu {

void SpiMaster::begin(Tick at, std::vector<std::uint8_t> out, const SpiFault& fault) {
  begin_ = std::max(at, free_at_);
  out_ = std::move(out);
  in_.assign(out_.size(), 0xFF);
  bits_ = std::min(8 * out_.size(), fault.cut_after.value_or(8 * out_.size()));
  flipped_ = fault.flipped_bit;
  edge_ = 0;
}

/// Edge 0 is XSS's fall, 1 + 2b and 2 + 2b are those of bit b, the last is XSS's rise.
Tick SpiMaster::tick_of(std::size_t edge) const {
  if (edge == 0) return begin_;
  const bool last = edge == edges() - 1;
  if (last && bits_ == 0) return begin_ + timing_.lead;
  const auto number = static_cast<Tick>(last ? bits_ - 1 : (edge - 1) / 2);
  const Tick rise = begin_ + timing_.lead + number * (timing_.high + timing_.low) + number / 8 * timing_.byte_gap;
  if (last) return rise + timing_.high + timing_.lag;
  return edge % 2 == 1 ? rise : rise + timing_.high;
}

bool SpiMaster::bit(std::size_t number) const {
  if (number >= 8 * out_.size()) return false;
  const bool level = (out_[number / 8] >> (7 - number % 8) & 1) != 0;
  return level != (flipped_ == number);
}

void SpiMaster::run(Tick now) {
  const std::size_t edge = edge_++;
  if (edge == 0) {
    pins_.set_serial(now, SerialPin::kXss, false);
    pins_.set_serial(now, SerialPin::kMosi, bit(0));
  } else if (done()) {
    pins_.set_serial(now, SerialPin::kXss, true);
    free_at_ = now + timing_.gap;
  } else if (edge % 2 == 1) {
    rise(now, edge / 2);
  } else {
    fall(now, edge / 2 - 1);
  }
}

void SpiMaster::rise(Tick now, std::size_t number) {
  const std::uint8_t mask = static_cast<std::uint8_t>(0x80U >> number % 8);
  std::uint8_t& byte = in_[number / 8];
  byte = static_cast<std::uint8_t>(pins_.miso(now) ? byte | mask : byte & ~mask);
  pins_.set_serial(now, SerialPin::kSck, true);
}

void SpiMaster::fall(Tick now, std::size_t number) {
  pins_.set_serial(now, SerialPin::kSck, false);
  pins_.set_serial(now, SerialPin::kMosi, bit(number + 1));
}

}  // namespace dsdpv1::user_cpu
