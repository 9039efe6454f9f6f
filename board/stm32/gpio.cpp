#include "board/stm32/gpio.hpp"

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kCrl = 0x00, kCrh = 0x04, kIdr = 0x08, kBsrr = 0x10, kBrr = 0x14, kLckr = 0x18;
// CNF[1:0] and MODE[1:0] of a pin, as they stand in CRL and CRH.
constexpr unsigned kModeMask = 0b0011, kAlternate = 0b1000, kOpenDrain = 0b0100, kPulledInput = 0b1000, kAnalog = 0;

// After a reset every pin is a floating input.
constexpr RegisterList kGpioRegisters = {{kCrl, "CRL", 0x4444'4444, 0xFFFF'FFFF},
                                         {kCrh, "CRH", 0x4444'4444, 0xFFFF'FFFF},
                                         {kIdr, "IDR"},
                                         {Gpio::kOdr, "ODR", 0, 0xFFFF},
                                         {kBsrr, "BSRR"},
                                         {kBrr, "BRR"},
                                         {kLckr, "LCKR", 0, 0x1'FFFF}};
constexpr TagList kGpioTags = {{kLckr, 16, 1, "LCKK"}};

}  // namespace

constexpr RegisterTable Gpio::kRegisters{kGpioRegisters, kGpioTags};

void Gpio::set_modes() {
  outputs_ = pushed_ = alternate_ = pushed_alternate_ = pulled_ = analog_ = 0;
  for (unsigned pin = 0; pin < 16; ++pin) {
    const unsigned mode = (words_[pin < 8 ? kCrl : kCrh] >> (pin % 8 * 4)) & 0xFU;
    const bool drives = (mode & kModeMask) != 0, other = (mode & kAlternate) != 0;
    const auto set = [pin](std::uint16_t& pins, bool is) {
      if (is) pins = static_cast<std::uint16_t>(pins | 1U << pin);
    };
    set(outputs_, drives && !other);
    set(pushed_, drives && !other && (mode & kOpenDrain) == 0);
    set(alternate_, drives && other);
    set(pushed_alternate_, drives && other && (mode & kOpenDrain) == 0);
    set(pulled_, mode == kPulledInput);
    set(analog_, mode == kAnalog);
  }
}

/// ODR chooses the direction in which an input is pulled.
std::uint16_t Gpio::input(std::uint16_t outside, std::uint16_t levels) const {
  const unsigned own = driven(), floating = pulled_ & words_[kOdr] & ~unsigned{outside};
  const unsigned pins = (own & words_[kOdr]) | (~own & ((outside & levels) | floating));
  return static_cast<std::uint16_t>(pins & ~unsigned{analog_});
}

std::uint32_t Gpio::read(std::uint32_t offset, std::uint16_t driven, std::uint16_t levels) const {
  return offset == kIdr ? input(driven, levels) : words_.read(offset);
}

std::uint32_t Gpio::addressed(std::uint32_t offset, std::uint32_t value) const {
  switch (offset) {
    case kBsrr: return (value | value >> 16U) & 0xFFFFU;
    case kBrr: return value & 0xFFFFU;
    case kOdr: return (value ^ words_[kOdr]) & 0xFFFFU;
    default: return 0;
  }
}

void Gpio::write(std::uint32_t offset, std::uint32_t value) {
  const std::uint32_t low = value & 0xFFFFU, odr = words_[kOdr];
  switch (offset) {
    case kBsrr: words_[kOdr] = (odr & ~(value >> 16U)) | low; break;  // of both, set wins
    case kBrr: words_[kOdr] = odr & ~low; break;
    default: words_.write(offset, value);
  }
  if (offset == kCrl || offset == kCrh) set_modes();
}

}  // namespace dsdpv1::arm
