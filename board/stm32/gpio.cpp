#include "board/stm32/gpio.hpp"

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kCrl = 0x00, kCrh = 0x04, kIdr = 0x08, kOdr = 0x0C, kBsrr = 0x10, kBrr = 0x14, kLckr = 0x18;
// CNF[1:0] and MODE[1:0] of a pin, as they stand in CRL and CRH.
constexpr unsigned kModeMask = 0b0011, kAlternate = 0b1000, kOpenDrain = 0b0100, kPulledInput = 0b1000, kAnalog = 0;

}  // namespace

void Gpio::set_modes() {
  outputs_ = pushed_ = alternate_ = pulled_ = analog_ = 0;
  for (unsigned pin = 0; pin < 16; ++pin) {
    const unsigned mode = ((pin < 8 ? crl_ : crh_) >> (pin % 8 * 4)) & 0xFU;
    const bool drives = (mode & kModeMask) != 0, other = (mode & kAlternate) != 0;
    const auto set = [pin](std::uint16_t& pins, bool is) {
      if (is) pins = static_cast<std::uint16_t>(pins | 1U << pin);
    };
    set(outputs_, drives && !other);
    set(pushed_, drives && !other && (mode & kOpenDrain) == 0);
    set(alternate_, drives && other);
    set(pulled_, mode == kPulledInput);
    set(analog_, mode == kAnalog);
  }
}

/// ODR chooses the direction in which an input is pulled.
std::uint16_t Gpio::input(std::uint16_t outside, std::uint16_t levels) const {
  const unsigned own = driven(), floating = pulled_ & odr_ & ~unsigned{outside};
  const unsigned pins = (own & odr_) | (~own & ((outside & levels) | floating));
  return static_cast<std::uint16_t>(pins & ~unsigned{analog_});
}

std::uint32_t Gpio::read(std::uint32_t offset, std::uint16_t driven, std::uint16_t levels) const {
  switch (offset) {
    case kCrl: return crl_;
    case kCrh: return crh_;
    case kIdr: return input(driven, levels);
    case kOdr: return odr_;
    case kLckr: return lckr_;
    default: return 0;
  }
}

void Gpio::write(std::uint32_t offset, std::uint32_t value) {
  const auto low = static_cast<std::uint16_t>(value), high = static_cast<std::uint16_t>(value >> 16U);
  switch (offset) {
    case kCrl:
      crl_ = value;
      set_modes();
      break;
    case kCrh:
      crh_ = value;
      set_modes();
      break;
    case kOdr: odr_ = low; break;
    case kBsrr: odr_ = static_cast<std::uint16_t>((odr_ & ~high) | low); break;  // of both, set wins
    case kBrr: odr_ = static_cast<std::uint16_t>(odr_ & ~low); break;
    case kLckr: lckr_ = value; break;
    default: break;
  }
}

}  // namespace dsdpv1::arm
