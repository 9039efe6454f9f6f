#pragma once
// The nested vectored interrupt controller with the priorities of all exceptions (ARMv7-M, B1.5.4 and B3.4), as logic
// without a processor.
#include <array>
#include <cstdint>

namespace dsdpv1::arm {

/// Exception numbers, ARMv7-M B1.5.2.
enum Exception : unsigned {
  kNoException = 0,
  kReset = 1,
  kNmi = 2,
  kHardFault = 3,
  kMemManage = 4,
  kBusFault = 5,
  kUsageFault = 6,
  kSvCall = 11,
  kDebugMonitor = 12,
  kPendSv = 14,
  kSysTick = 15,
  kFirstInterrupt = 16,
};

/// Neither heap nor time. Exceptions are numbered as in IPSR: external interrupt n is 16 + n.
class Nvic {
 public:
  static constexpr unsigned kInterrupts = 68;  ///< of an STM32F107; fewer on smaller ones do not matter
  static constexpr unsigned kExceptions = kFirstInterrupt + kInterrupts;
  static constexpr int kIdlePriority = 256;            ///< of thread mode: any exception preempts
  static constexpr std::uint8_t kPriorityBits = 0xF0;  ///< the 4 bits that the STM32F1 implements

  /// The special registers that raise the execution priority (B1.4.3).
  struct Masks {
    bool primask;
    bool faultmask;
    std::uint8_t basepri;  ///< 0: none
  };

  Nvic() { reset(); }
  void reset();

  void set_pending(unsigned exception);
  /// It stays pending while its source is level-sensitive and high.
  void clear_pending(unsigned exception);
  /// The level of an external interrupt's source: while high, the interrupt is pending again whenever it is not active
  /// (B3.4.1).
  void set_level(unsigned exception, bool high);
  bool pending(unsigned exception) const { return state_[exception].pending; }
  bool active(unsigned exception) const { return state_[exception].active; }
  bool enabled(unsigned exception) const { return state_[exception].enabled; }

  /// The exception is taken: active, no longer pending.
  void begin(unsigned exception);
  /// Its handler returned.
  void end(unsigned exception);
  /// How often its handler has returned since its source was low last.
  unsigned unserved(unsigned exception) const { return state_[exception].unserved; }
  unsigned active_count() const { return active_count_; }

  /// 0 to 255 with four bits implemented; of reset, NMI and HardFault it is fixed.
  void set_priority(unsigned exception, std::uint8_t priority);
  std::uint8_t priority(unsigned exception) const { return state_[exception].priority; }
  /// AIRCR.PRIGROUP, 0 to 7: bits [PRIGROUP:0] of a priority order pending exceptions only, the others preempt.
  void set_grouping(unsigned prigroup);
  unsigned grouping() const { return grouping_; }

  /// Least group priority of what is active, kIdlePriority when nothing is.
  int active_priority() const { return active_priority_; }
  /// active_priority() raised by the masks.
  int execution_priority(const Masks& masks) const;
  /// The exception that goes first of all that are pending and enabled; kNoException when none is.
  unsigned foremost() const { return foremost_; }
  /// foremost() when it preempts execution at this priority, otherwise kNoException.
  unsigned preempting(int execution_priority) const;
  int group_priority(unsigned exception) const;

  /// Registers from 0xE000E100 to 0xE000E4EF, `offset` from 0xE000E000 and a multiple of 4. `lanes` has ones in the
  /// bytes that are written.
  std::uint32_t load(std::uint32_t offset) const;
  void store(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes);
  /// Four priorities from exception `first` on, as SHPR and IPR hold them.
  std::uint32_t load_priorities(unsigned first) const;
  void store_priorities(unsigned first, std::uint32_t value, std::uint32_t lanes);

 private:
  struct State {
    bool pending, active, enabled, level;
    std::uint8_t priority;
    unsigned unserved;
  };
  template <typename Test>
  std::uint32_t collect(unsigned first, Test test) const;
  template <typename Action>
  void for_each_bit(unsigned first, std::uint32_t bits, Action action);
  bool goes_before(unsigned one, unsigned other) const;
  int full_priority(unsigned exception) const;
  void update_active();
  void update_foremost();

  std::array<State, kExceptions> state_{};
  unsigned grouping_ = 0, active_count_ = 0;
  unsigned foremost_ = kNoException;  // kept up to date: asked far more often than anything changes
  int active_priority_ = kIdlePriority;
};

}  // namespace dsdpv1::arm
