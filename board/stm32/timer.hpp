#pragma once
// TIM2 to TIM5 of the STM32F103 (RM0008, chapter 15) as time bases: they count up, set UIF and ask for their
// interrupt. Times are cycles of HCLK. Assumed (p): CNT begins with the second cycle of the timer's clock after CEN;
// one whose ARR is less than CNT counts to 0xFFFF.
#include <cstdint>
#include <limits>

#include "board/stm32/registers.hpp"

namespace dsdpv1::arm {

class Timer {
 public:
  static constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();
  static constexpr std::uint32_t kCr1 = 0x00, kDier = 0x0C, kSr = 0x10, kEgr = 0x14, kCnt = 0x24, kPsc = 0x28,
                                 kArr = 0x2C;
  static const RegisterTable kRegisters;

  /// Cycles of HCLK in a cycle of the timer's clock; `clocked` false: it stands still.
  void follow(unsigned hclk_cycles, bool clocked, std::uint64_t now);
  /// As after a reset, except the clock.
  void reset();

  std::uint32_t read(std::uint32_t offset, std::uint64_t now);
  /// As read(), without an effect.
  std::uint32_t peek(std::uint32_t offset, std::uint64_t now) const;
  void write(std::uint32_t offset, std::uint32_t value, std::uint64_t now);

  /// The cycle at which it will ask for its interrupt, kNever when it does not, or does already.
  std::uint64_t next() const;
  /// Everything up to and with cycle `now` has happened.
  void catch_up(std::uint64_t now);
  /// Asks for its interrupt.
  bool asks() const { return (words_[kSr] & words_[kDier] & kUif) != 0; }

 private:
  static constexpr std::uint32_t kCen = 1U << 0U, kUdis = 1U << 1U, kUrs = 1U << 2U, kOpm = 1U << 3U, kArpe = 1U << 7U;
  static constexpr std::uint32_t kUif = 1U << 0U, kUg = 1U << 0U;

  bool runs() const { return clocked_ && (words_[kCr1] & kCen) != 0 && limit_ != 0; }
  std::uint64_t step() const { return (std::uint64_t{prescaler_} + 1) * divider_; }
  std::uint64_t overflow_at() const;
  std::uint32_t count_at(std::uint64_t now) const;
  void begin(std::uint64_t now);
  void rebase(std::uint64_t now);
  void overflow();
  void update();
  void generate(std::uint64_t now);

  unsigned divider_ = 1;
  bool clocked_ = true;
  RegisterWords<kRegisters, 20> words_;
  std::uint32_t prescaler_ = 0, limit_ = 0xFFFF;  ///< of PSC and ARR, as in force
  std::uint64_t since_ = 0;                       ///< the cycle at which CNT had the value of its register
};

}  // namespace dsdpv1::arm
