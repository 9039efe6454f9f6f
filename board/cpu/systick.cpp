#include "board/cpu/systick.hpp"

namespace dsdpv1::arm {

namespace {

constexpr std::uint32_t kCtrl = 0x10, kLoad = 0x14, kVal = 0x18, kCalib = 0x1C;
constexpr std::uint32_t kCounterBits = 0x00FFFFFF;
constexpr std::uint32_t kCalibration = 9000;  // 1 ms of HCLK / 8 at 72 MHz (STM32F1 reference manual, 10.1.1)

}  // namespace

bool SysTick::catch_up(std::uint64_t now) {
  if (now < zero_at_) return false;
  control_ |= kCountFlag;
  if (reload_ == 0) {
    zero_at_ = kNever;  // without a reload value it stays at zero (B3.3.1)
    stopped_value_ = 0;
  } else {
    const std::uint64_t period = (reload_ + 1ULL) * divider();
    zero_at_ += ((now - zero_at_) / period + 1) * period;
    loaded_ = reload_;
  }
  return (control_ & kTickInt) != 0;
}

std::uint32_t SysTick::value(std::uint64_t now) const {
  if (zero_at_ == kNever) return stopped_value_;
  const std::uint64_t left = (zero_at_ - now + divider() - 1) / divider();
  return left > loaded_ ? 0 : static_cast<std::uint32_t>(left);  // zero for one count before the reload
}

void SysTick::start(std::uint32_t value, std::uint64_t now) {
  if (value == 0 && reload_ == 0) {
    zero_at_ = kNever;
    stopped_value_ = 0;
    return;
  }
  loaded_ = value == 0 ? reload_ : value;
  zero_at_ = now + (loaded_ + (value == 0 ? 1ULL : 0ULL)) * divider();
}

void SysTick::store_control(std::uint32_t value, std::uint64_t now) {
  const std::uint32_t present = this->value(now);
  control_ = (control_ & kCountFlag) | (value & (kEnable | kTickInt | kClkSource));
  if ((control_ & kEnable) != 0) {
    start(present, now);
  } else {
    zero_at_ = kNever;
    stopped_value_ = present;
  }
}

std::uint32_t SysTick::peek(std::uint32_t offset, std::uint64_t now) const {
  switch (offset) {
    case kCtrl: return control_;
    case kLoad: return reload_;
    case kVal: return value(now);
    case kCalib: return kCalibration;
    default: return 0;
  }
}

std::uint32_t SysTick::load(std::uint32_t offset, std::uint64_t now) {
  const std::uint32_t value = peek(offset, now);
  if (offset == kCtrl) control_ &= ~kCountFlag;
  return value;
}

void SysTick::store(std::uint32_t offset, std::uint32_t value, std::uint64_t now) {
  switch (offset) {
    case kCtrl: store_control(value, now); break;
    case kLoad: reload_ = value & kCounterBits; break;
    case kVal:  // any write clears the counter and COUNTFLAG, without an exception
      control_ &= ~kCountFlag;
      stopped_value_ = 0;
      if ((control_ & kEnable) != 0) start(0, now);
      break;
    default: break;
  }
}

}  // namespace dsdpv1::arm
