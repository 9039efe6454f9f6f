#pragma once
// The system timer (ARMv7-M, B3.3), by deadlines: nothing is done while it counts.
#include <cstdint>
#include <limits>

namespace dsdpv1::arm {

/// Cycles of HCLK at which nothing happens.
constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();

/// All times are cycles of HCLK. CLKSOURCE 0 counts HCLK / 8, as the STM32F1 wires STCLK.
class SysTick {
 public:
  void reset() { *this = SysTick(); }

  /// Brings the counter up to `now`; true when it reached zero since the last time and the exception is wanted
  /// (TICKINT).
  bool catch_up(std::uint64_t now);
  /// The cycle at which the counter next reaches zero and asks for its exception; kNever when it does not.
  std::uint64_t next() const { return (control_ & (kEnable | kTickInt)) == (kEnable | kTickInt) ? zero_at_ : kNever; }

  /// Registers at `offset` 0x10 CTRL, 0x14 LOAD, 0x18 VAL, 0x1C CALIB, whole words; after catch_up(now). A load of CTRL
  /// clears COUNTFLAG, `peek` does not.
  std::uint32_t load(std::uint32_t offset, std::uint64_t now);
  std::uint32_t peek(std::uint32_t offset, std::uint64_t now) const;
  void store(std::uint32_t offset, std::uint32_t value, std::uint64_t now);

 private:
  static constexpr std::uint32_t kEnable = 1, kTickInt = 2, kClkSource = 4, kCountFlag = 1U << 16;
  std::uint64_t divider() const { return (control_ & kClkSource) != 0 ? 1 : 8; }
  std::uint32_t value(std::uint64_t now) const;
  void start(std::uint32_t value, std::uint64_t now);
  void store_control(std::uint32_t value, std::uint64_t now);

  std::uint32_t control_ = 0, reload_ = 0;
  std::uint32_t loaded_ = 0;         // what the present count began with
  std::uint32_t stopped_value_ = 0;  // while not enabled, and the zero at which a counter without reload stays
  std::uint64_t zero_at_ = kNever;   // while enabled: when the counter next changes from 1 to 0
};

}  // namespace dsdpv1::arm
