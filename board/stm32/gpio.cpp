#include "board/stm32/gpio.hpp"

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kCrl = 0x00, kCrh = 0x04, kIdr = 0x08, kOdr = 0x0C, kBsrr = 0x10, kBrr = 0x14, kLckr = 0x18;
// CNF[1:0] and MODE[1:0] of a pin, as they stand in CRL and CRH.
constexpr unsigned kModeMask = 0b0011, kAlternate = 0b1000, kOpenDrain = 0b0100, kPulledInput = 0b1000, kAnalog = 0;

}  // namespace

unsigned Gpio::mode(unsigned pin) const { return ((pin < 8 ? crl_ : crh_) >> (pin % 8 * 4)) & 0xFU; }

bool Gpio::drives(unsigned pin) const {
  const unsigned mode = this->mode(pin);
  if ((mode & kModeMask) == 0 || (mode & kAlternate) != 0) return false;
  return (mode & kOpenDrain) == 0 || (odr_ >> pin & 1U) == 0;
}

bool Gpio::is_alternate(unsigned pin) const {
  const unsigned mode = this->mode(pin);
  return (mode & kModeMask) != 0 && (mode & kAlternate) != 0;
}

std::uint16_t Gpio::input(std::uint16_t driven, std::uint16_t levels) const {
  unsigned idr = 0;
  for (unsigned pin = 0; pin < 16; ++pin) {
    const bool outside = (driven >> pin & 1U) != 0;
    const bool pulled = mode(pin) == kPulledInput && (odr_ >> pin & 1U) != 0;  // ODR chooses the direction
    if (mode(pin) == kAnalog) continue;                                        // its Schmitt trigger is off
    const bool high = drives(pin) ? (odr_ >> pin & 1U) != 0 : outside ? (levels >> pin & 1U) != 0 : pulled;
    idr |= static_cast<unsigned>(high) << pin;
  }
  return static_cast<std::uint16_t>(idr);
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
    case kCrl: crl_ = value; break;
    case kCrh: crh_ = value; break;
    case kOdr: odr_ = low; break;
    case kBsrr: odr_ = static_cast<std::uint16_t>((odr_ & ~high) | low); break;  // of both, set wins
    case kBrr: odr_ = static_cast<std::uint16_t>(odr_ & ~low); break;
    case kLckr: lckr_ = value; break;
    default: break;
  }
}

}  // namespace dsdpv1::arm
