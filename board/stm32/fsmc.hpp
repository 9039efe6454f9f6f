#pragma once
// The FSMC of the STM32F103, bank 1 region 1 (NE1), where the chip is (RM0008, chapter FSMC): its registers.
#include <array>
#include <cstdint>

#include "board/stm32/fsmc_timing.hpp"

namespace dsdpv1::arm {

class Fsmc {
 public:
  static constexpr std::uint32_t kBase = 0xA000'0000, kSize = 0x120;

  explicit Fsmc(const user_cpu::FsmcOverride& given) : given_(given) {}

  /// Registers of the bank: BCR1 0x000, BTR1 0x004, BWTR1 0x104; others are kept and do nothing.
  std::uint32_t read(std::uint32_t offset) const;
  void write(std::uint32_t offset, std::uint32_t value);

  /// As the firmware's registers say, with the scenario's values on top. What the firmware never wrote is as FsmcBank's
  /// defaults.
  user_cpu::FsmcBank bank(std::int64_t hclk_hz) const;
  /// The firmware has switched the bank off (MBKEN), or writing to it (WREN).
  bool refuses(bool write) const;
  /// The firmware has chosen a bus of 16 bits (MWID); the chip has 8.
  bool is_wide() const;

 private:
  static constexpr std::size_t kWords = kSize / 4;
  user_cpu::FsmcOverride given_;
  std::array<std::uint32_t, kWords> words_{};
  std::array<bool, kWords> written_{};
};

}  // namespace dsdpv1::arm
