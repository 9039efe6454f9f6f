#include "board/stm32/watchdog.hpp"

#include <algorithm>

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kStart = 0xCCCC, kReload = 0xAAAA, kOpen = 0x5555;
constexpr int kUpdate = 5;  // 19.4.4: up to five cycles
constexpr RegisterList kWatchdogRegisters = {
    {0x00, "KR"}, {0x04, "PR", 0, 7}, {0x08, "RLR", 0xFFF, 0xFFF}, {0x0C, "SR"}};
constexpr TagList kNoTags = {};

}  // namespace

constexpr RegisterTable Watchdog::kRegisters{kWatchdogRegisters, kNoTags};

std::uint32_t Watchdog::read(std::uint32_t offset, Tick now) const {
  if (offset != kSr) return words_.read(offset);
  return static_cast<std::uint32_t>(busy_until_[0] > now) | static_cast<std::uint32_t>(busy_until_[1] > now) << 1U;
}

/// Any other key than 5555 closes PR and RLR (19.3.2).
void Watchdog::write(std::uint32_t offset, std::uint32_t value, Tick now) {
  if (offset == kKr) {
    const std::uint32_t key = value & 0xFFFFU;
    open_ = key == kOpen;
    if (key == kReload) load(words_[kRlr], now);
    if (key == kStart && !runs_) {
      runs_ = true;
      load(count_, now);
    }
  } else if (open_ && offset != kSr) {
    words_.write(offset, value);
    busy_until_.at(offset == kPr ? 0 : 1) = now + kUpdate * lsi_;
    if (offset == kPr) load(count_, now);
  }
}

/// PR: 4, 8, 16, 32, 64, 128, 256, 256 cycles of the LSI.
Watchdog::Tick Watchdog::step() const { return lsi_ * (Tick{4} << std::min(words_[kPr], 6U)); }

void Watchdog::load(std::uint32_t count, Tick now) {
  count_ = count;
  loaded_at_ = now;
  end_ = now + (Tick{count} + 1) * step();
}

}  // namespace dsdpv1::arm
