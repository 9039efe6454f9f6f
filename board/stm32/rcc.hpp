#pragma once
// Reset and clock control of the STM32F103 (RM0008, chapter RCC), as start-up code sees it: every oscillator is ready
// at once and the switch follows at once, to a source that is on.
#include <array>
#include <cstdint>
#include <string>

namespace dsdpv1::arm {

class Rcc {
 public:
  std::uint32_t read(std::uint32_t offset) const;
  void write(std::uint32_t offset, std::uint32_t value);

  /// Frequency of HCLK: 8 MHz, the HSI, after a reset. The board's crystal (HSE) has 8 MHz (p).
  std::int64_t hclk_hz() const;
  /// Where it comes from: "HSI", "PLL, 9 x HSE".
  std::string hclk_source() const;

  /// Clock enables of AHB, APB2, APB1.
  std::uint32_t ahb_clocks() const { return word(0x14); }
  std::uint32_t apb2_clocks() const { return word(0x18); }
  std::uint32_t apb1_clocks() const { return word(0x1C); }
  /// Peripherals of APB2 and APB1 that are held in reset.
  std::uint32_t apb2_resets() const { return word(0x0C); }
  std::uint32_t apb1_resets() const { return word(0x10); }
  /// Cycles of HCLK that one of PCLK1, PCLK2 lasts: 1, 2, 4, 8, 16.
  unsigned apb1_divider() const;
  unsigned apb2_divider() const;

 private:
  static constexpr std::size_t kWords = 10;  // CR ... CSR
  enum Source : unsigned { kHsi, kHse, kPll };
  bool is_on(unsigned source) const;
  std::uint32_t word(std::uint32_t offset) const { return words_.at(offset / 4); }

  unsigned source_ = kHsi;  ///< of the system clock: SWS
  // Values after a reset: HSI on; the clock of RAM and flash interface; power-on and pin reset.
  std::array<std::uint32_t, kWords> words_ = {0x83, 0, 0, 0, 0, 0x14, 0, 0, 0, 0x0C00'0000};
};

}  // namespace dsdpv1::arm
