#pragma once
// A user CPU that runs a C++ program on a separate stack, and suspends it during every access and wait. An access is
// one register call of the chip at its end; it has no edges. The DSDPV1 has its own: most of that one is its handshake.
#include <cstdint>
#include <functional>

#include "bus/time.hpp"
#include "kinds/spc3/user_cpu/register_call.hpp"
#include "tb/chip/user_cpu/fiber.hpp"
#include "tb/chip/user_cpu/others.hpp"
#include "tb/chip/user_cpu/program.hpp"

namespace dsdpv1::spc3_user {

/// Ticks of 1/12 ns.
struct CpuTiming {
  Tick access = 2000;             ///< of one byte with the instructions round it: 166.7 ns
  Tick interrupt_latency = 2000;  ///< from X/INT to the first instruction of its handler
};

class NativeCpu {
 public:
  /// `chip` and `timing` must outlive it. The program begins at `start`.
  NativeCpu(RegisterCall& chip, const CpuTiming& timing, std::function<void()> program, Tick start);

  // --- The bench's side. Exceptions of the program leave through `run`.
  Tick next() const;
  void run(Tick now);
  user_cpu::Others* others = nullptr;
  /// X/INT has become active at `at`; may be called while the chip runs ahead.
  void interrupt(Tick at) { interrupt_at_ = std::min(interrupt_at_, at + timing_.interrupt_latency); }
  /// Ends a `wait_for_wake`, the present or the next one, not before `at`.
  void wake(Tick at) { wake_at_ = std::min(wake_at_, at); }
  const user_cpu::CpuCounters& counters() const { return counters_; }

  // --- The program's side.
  Tick now() const { return now_; }
  std::uint8_t read(std::uint16_t address);
  void write(std::uint16_t address, std::uint8_t value);
  /// The handler of the interrupt runs meanwhile.
  void wait_until(Tick at);
  /// True: `wake` was called before `until`.
  bool wait_for_wake(Tick until);
  /// It cannot be interrupted. Null: none.
  void on_interrupt(std::function<void()> handler) { handler_ = std::move(handler); }

 private:
  enum class Op : std::uint8_t { kRead, kWrite, kWait, kWaitForWake };

  bool interrupt_is_due() const { return handler_ && !in_handler_ && interrupt_at_ <= now_; }
  void act();
  void access(Op op, std::uint16_t address, std::uint8_t value);
  void suspend_until(Tick at, Op op);
  void serve_interrupt();

  RegisterCall& chip_;
  const CpuTiming timing_;
  user_cpu::CpuCounters counters_;
  std::function<void()> handler_;
  bool in_handler_ = false;
  Tick interrupt_at_ = bus::kNever, wake_at_ = bus::kNever;
  Tick now_ = 0;
  Tick ready_at_;  ///< when the program continues
  Op op_ = Op::kWait;
  std::uint16_t address_ = 0;
  std::uint8_t value_ = 0;
  user_cpu::Fiber fiber_;
};

}  // namespace dsdpv1::spc3_user
