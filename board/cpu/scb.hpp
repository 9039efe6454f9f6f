#pragma once
// The system control block and the cycle counter of the debug unit (ARMv7-M, B3.2, C1.6.5, C1.8): what the processor
// remembers of them.
#include <cstdint>

#include "board/cpu/nvic.hpp"

namespace dsdpv1::arm {

/// Configurable Fault Status Register, B3.2.15.
enum FaultStatus : std::uint32_t {
  kIaccViol = 1U << 0,
  kBfIbusErr = 1U << 8,
  kBfPrecisErr = 1U << 9,
  kBfUnstkErr = 1U << 11,
  kBfStkErr = 1U << 12,
  kBfArValid = 1U << 15,
  kUfUndefInstr = 1U << 16,
  kUfInvState = 1U << 17,
  kUfInvPc = 1U << 18,
  kUfNoCp = 1U << 19,
  kUfUnaligned = 1U << 24,
};

/// HardFault Status Register, B3.2.16.
enum HardFaultStatus : std::uint32_t { kHfVectTbl = 1U << 1, kHfForced = 1U << 30, kHfDebugEvt = 1U << 31 };

/// Registers from 0xE000ED00 to 0xE000ED3C, DEMCR and DWT. Pending and active bits of exceptions are those of the Nvic.
class Scb {
 public:
  void reset();

  /// `offset` from 0xE000E000, a multiple of 4. `handler` is the exception in IPSR.
  std::uint32_t load(std::uint32_t offset, const Nvic& nvic, unsigned handler) const;
  void store(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes, Nvic& nvic);

  std::uint32_t vector_table() const { return vtor_; }
  bool stack_align() const { return (ccr_ & kStkAlign) != 0; }
  bool return_to_thread_from_nested() const { return (ccr_ & kNonBaseThreadEnable) != 0; }
  bool sleep_on_exit() const { return (scr_ & kSleepOnExit) != 0; }
  bool event_on_pend() const { return (scr_ & kSevOnPend) != 0; }
  /// MemManage, BusFault or UsageFault has its own handler (SHCSR).
  bool handles(unsigned fault) const { return (shcsr_ >> (fault + kEnablesFrom - kMemManage) & 1U) != 0; }

  void record_fault(std::uint32_t cfsr_bits) { cfsr_ |= cfsr_bits; }
  void record_bus_fault(std::uint32_t cfsr_bits, std::uint32_t address);
  void record_hard_fault(std::uint32_t hfsr_bits) { hfsr_ |= hfsr_bits; }

  /// Once after AIRCR.SYSRESETREQ was written.
  bool take_reset_request();

  /// DEMCR at offset 0xDFC.
  bool trace_enabled() const { return (demcr_ & kTrcEna) != 0; }

  /// DWT at 0xE0001000: CTRL 0, CYCCNT 4. `cycles` is the processor's own count.
  std::uint32_t load_dwt(std::uint32_t offset, std::uint64_t cycles) const;
  void store_dwt(std::uint32_t offset, std::uint32_t value, std::uint64_t cycles);

 private:
  static constexpr std::uint32_t kStkAlign = 1U << 9, kNonBaseThreadEnable = 1U << 0;
  static constexpr std::uint32_t kSleepOnExit = 1U << 1, kSevOnPend = 1U << 4;
  static constexpr std::uint32_t kTrcEna = 1U << 24, kCycCntEna = 1;
  static constexpr unsigned kEnablesFrom = 16;  // SHCSR.MEMFAULTENA; BUSFAULTENA and USGFAULTENA follow

  std::uint32_t interrupt_control(const Nvic& nvic, unsigned handler) const;
  std::uint32_t handler_control(const Nvic& nvic) const;
  void store_interrupt_control(std::uint32_t value, Nvic& nvic);
  void store_reset_control(std::uint32_t value, std::uint32_t lanes, Nvic& nvic);
  bool counting() const { return trace_enabled() && (dwt_control_ & kCycCntEna) != 0; }

  std::uint32_t vtor_ = 0, scr_ = 0, ccr_ = kStkAlign, shcsr_ = 0, cfsr_ = 0, hfsr_ = 0, mmfar_ = 0, bfar_ = 0,
                demcr_ = 0;
  bool reset_request_ = false;
  std::uint32_t dwt_control_ = 0, cycle_count_ = 0;  // the count while it stands
  std::uint64_t counts_from_ = 0;                    // cycle at which CYCCNT was, or would have been, zero
};

}  // namespace dsdpv1::arm
