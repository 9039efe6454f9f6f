#pragma once
// The independent watchdog of the STM32F103 (IWDG; RM0008, chapter 19). It counts cycles of the LSI, not
// of HCLK: times are the bench's ticks.
#include <array>
#include <cstdint>
#include <limits>

#include "board/stm32/registers.hpp"

namespace dsdpv1::arm {

class Watchdog {
 public:
  static const RegisterTable kRegisters;
  using Tick = std::int64_t;
  static constexpr Tick kNever = std::numeric_limits<Tick>::max();

  /// `lsi`: a cycle of the LSI.
  explicit Watchdog(Tick lsi) : lsi_(lsi) {}

  std::uint32_t read(std::uint32_t offset, Tick now) const;
  void write(std::uint32_t offset, std::uint32_t value, Tick now);

  /// When it resets the processor, kNever before it is started.
  Tick next() const { return runs_ ? end_ : kNever; }
  /// From the last reload to next().
  Tick length() const { return end_ - loaded_at_; }

 private:
  static constexpr std::uint32_t kKr = 0x00, kPr = 0x04, kRlr = 0x08, kSr = 0x0C;
  Tick step() const;
  void load(std::uint32_t count, Tick now);

  Tick lsi_;
  RegisterWords<kRegisters, 4> words_;
  bool open_ = false, runs_ = false;
  std::uint32_t count_ = 0xFFF;  ///< as loaded
  Tick loaded_at_ = 0, end_ = 0;
  std::array<Tick, 2> busy_until_{};  ///< PVU, RVU
};

}  // namespace dsdpv1::arm
