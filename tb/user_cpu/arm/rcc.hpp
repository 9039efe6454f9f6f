#pragma once
// Reset and clock control of the STM32F103 (RM0008, chapter RCC), as start-up code sees it: every oscillator is ready at once and the switch
// follows at once. The board's clock does not follow these registers: HCLK is 72 MHz from the first instruction on.
#include <array>
#include <cstdint>

namespace arm {

class Rcc {
 public:
  std::uint32_t read(std::uint32_t offset) const;
  void write(std::uint32_t offset, std::uint32_t value);

  /// Clock enables of AHB, APB2, APB1.
  std::uint32_t ahb_clocks() const { return word(0x14); }
  std::uint32_t apb2_clocks() const { return word(0x18); }

 private:
  static constexpr std::size_t kWords = 10;  // CR ... CSR
  std::uint32_t word(std::uint32_t offset) const { return words_.at(offset / 4); }

  // Values after a reset: HSI on; the clock of RAM and flash interface; power-on and pin reset.
  std::array<std::uint32_t, kWords> words_ = {0x83, 0, 0, 0, 0, 0x14, 0, 0, 0, 0x0C00'0000};
};

}  // namespace arm
