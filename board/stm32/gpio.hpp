#pragma once
// A GPIO port of the STM32F103 (RM0008, chapter GPIO): its registers, and what they make of 16 pins.
#include <cstdint>

#include "board/stm32/registers.hpp"

namespace dsdpv1::arm {

class Gpio {
 public:
  static constexpr std::uint32_t kOdr = 0x0C;
  static const RegisterTable kRegisters;

  /// `driven`: pins that are driven from outside, `levels`: how.
  std::uint32_t read(std::uint32_t offset, std::uint16_t driven, std::uint16_t levels) const;
  void write(std::uint32_t offset, std::uint32_t value);

  /// Pins that the port drives (general purpose output, push-pull or open drain with 0).
  bool drives(unsigned pin) const { return (driven() >> pin & 1U) != 0; }
  /// Pins that are left to a peripheral's output (alternate function, push-pull or open drain).
  bool is_alternate(unsigned pin) const { return (alternate_ >> pin & 1U) != 0; }
  bool is_pushed_alternate(unsigned pin) const { return (pushed_alternate_ >> pin & 1U) != 0; }
  /// General purpose outputs; those that drive both levels.
  bool is_output(unsigned pin) const { return (outputs_ >> pin & 1U) != 0; }
  bool is_pushed(unsigned pin) const { return (pushed_ >> pin & 1U) != 0; }
  /// An input whose Schmitt trigger is off: it reads 0.
  bool is_analog(unsigned pin) const { return (analog_ >> pin & 1U) != 0; }
  /// Bits of ODR that a store to this register sets or clears, whether they change or not; of ODR itself: that change.
  std::uint32_t addressed(std::uint32_t offset, std::uint32_t value) const;
  /// The pin when the port drives it, else `floating`: what the board pulls it to.
  bool level(unsigned pin, bool floating) const { return drives(pin) ? (words_[kOdr] >> pin & 1U) != 0 : floating; }

 private:
  unsigned driven() const { return outputs_ & (pushed_ | ~words_[kOdr]); }
  std::uint16_t input(std::uint16_t outside, std::uint16_t levels) const;
  void set_modes();

  RegisterWords<kRegisters, 7> words_;
  // CRL and CRH, pin by pin: general purpose outputs and alternate functions, those of them that drive 1, too,
  // inputs with a pull-up or -down, inputs whose Schmitt trigger is off.
  std::uint16_t outputs_ = 0, pushed_ = 0, alternate_ = 0, pushed_alternate_ = 0, pulled_ = 0, analog_ = 0;
};

}  // namespace dsdpv1::arm
