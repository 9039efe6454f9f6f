#pragma once
// The flash interface of the STM32F103 (RM0008, chapter embedded flash memory; PM0075): how long a fetch takes. It
// programs nothing and stays locked.
#include <algorithm>
#include <cstdint>

#include "board/stm32/registers.hpp"

namespace dsdpv1::arm {

class FlashInterface {
 public:
  static constexpr std::uint32_t kAcr = 0x00;
  static const RegisterTable kRegisters;

  std::uint32_t read(std::uint32_t offset) const;
  void write(std::uint32_t offset, std::uint32_t value) { words_.write(offset, value); }

  /// LATENCY, 0 to 2; 3 to 7 are reserved and count as 2.
  unsigned wait_states() const { return std::min(words_[kAcr] & 7U, 2U); }
  /// The prefetch buffer is on (PRFTBE).
  bool prefetch() const { return (words_[kAcr] & kPrftbe) != 0; }

 private:
  static constexpr std::uint32_t kPrftbe = 1U << 4U;
  RegisterWords<kRegisters, 9> words_;
};

}  // namespace dsdpv1::arm
