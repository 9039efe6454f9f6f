#pragma once
// Reset and clock control of the STM32F103 (RM0008, chapter RCC), as start-up code sees it: every oscillator is ready
// at once and the switch follows at once, to a source that is on.
#include <cstdint>
#include <string>

#include "board/stm32/registers.hpp"

namespace dsdpv1::arm {

class Rcc {
 public:
  static const RegisterTable kRegisters;

  std::uint32_t read(std::uint32_t offset) const;
  void write(std::uint32_t offset, std::uint32_t value);

  /// A system reset, which leaves the flags of earlier ones (7.3.10).
  void reset(bool by_watchdog);

  /// Frequency of HCLK: 8 MHz, the HSI, after a reset. The board's crystal (HSE) has 8 MHz (p).
  std::int64_t hclk_hz() const;
  /// The clock that the AHB divider makes it of, which flash works with.
  std::int64_t sysclk_hz() const;
  /// Where it comes from: "HSI", "PLL, 9 x HSE".
  std::string hclk_source() const;

  /// Clock enables.
  static constexpr std::uint32_t kAhbenr = 0x14, kApb2enr = 0x18, kApb1enr = 0x1C;
  bool is_clocked(std::uint32_t enables, unsigned bit) const { return (words_[enables] >> bit & 1U) != 0; }
  /// Peripherals of APB2 and APB1 that are held in reset.
  std::uint32_t apb2_resets() const { return words_[0x0C]; }
  std::uint32_t apb1_resets() const { return words_[0x10]; }
  /// Cycles of HCLK in a cycle of PCLK1, PCLK2: 1, 2, 4, 8, 16.
  unsigned apb1_divider() const;
  unsigned apb2_divider() const;

 private:
  enum Source : unsigned { kHsi, kHse, kPll };
  bool is_on(unsigned source) const;

  unsigned source_ = kHsi;  ///< of the system clock: SWS
  RegisterWords<kRegisters, 10> words_;
};

}  // namespace dsdpv1::arm
