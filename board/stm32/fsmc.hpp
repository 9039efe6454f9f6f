#pragma once
// The FSMC of the STM32F103, bank 1 region 1 (NE1), where the chip is (RM0008, chapter FSMC): its registers.
#include <cstdint>

#include "board/stm32/fsmc_timing.hpp"
#include "board/stm32/registers.hpp"

namespace dsdpv1::arm {

class Fsmc {
 public:
  static constexpr std::uint32_t kBase = 0xA000'0000, kSize = 0x1000;
  static const RegisterTable kRegisters;

  explicit Fsmc(const user_cpu::FsmcOverride& given) : given_(given) {}

  std::uint32_t read(std::uint32_t offset) const { return words_.read(offset); }
  void write(std::uint32_t offset, std::uint32_t value);

  /// As the firmware's registers say, with the scenario's values on top. Registers that the firmware never wrote give
  /// FsmcBank's defaults.
  user_cpu::FsmcBank bank(std::int64_t hclk_hz) const;
  /// The firmware has switched the bank off (MBKEN), or writing to it (WREN).
  bool refuses(bool write) const;
  /// Other than 8 bits (MWID); the address on the data lines (MUXEN).
  bool is_wide() const;
  bool is_multiplexed() const;
  /// An asynchronous access waits for NWAIT (ASYNCWAIT); as long as it is high (WAITPOL), else low.
  bool waits() const;
  bool waits_while_high() const;
  /// The tag of ASYNCWAIT, which a board without a memory at NWAIT does not follow.
  static bool is_wait(const Tag& tag);

 private:
  user_cpu::FsmcOverride given_;
  RegisterWords<kRegisters, 0x120 / 4> words_;
  bool btr1_written_ = false, bwtr1_written_ = false;
};

}  // namespace dsdpv1::arm
