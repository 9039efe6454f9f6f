#pragma once
// A user CPU that runs a C++ program on a separate stack and suspends it during every access and wait, so that blocking
// code like the driver takes simulated time.
#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>

#include "bus/timeline.hpp"
#include "kinds/user_cpu/cpu.hpp"
#include "tb/chip/user_cpu/fiber.hpp"
#include "tb/chip/user_cpu/others.hpp"
#include "tb/chip/user_cpu/program.hpp"

namespace dsdpv1::user_cpu {

/// Only `run` uses the bus, on the bench's stack. Exceptions of the program leave through `run`.
class NativeCpu : public bus::Agent, private Cpu {
 public:
  using Program = std::function<void(Cpu&)>;

  /// The program begins at `start`. `bus` must outlive the CPU.
  NativeCpu(HostBus& bus, const CpuTiming& timing, Program program, Tick start = 0);

  Tick next() const override;
  void run(Tick now) override;
  /// Tick of the last action: after a turn that was extended, the last of its ticks.
  Tick now() const override { return now_; }

  /// As in StationCpu.
  Others* others = nullptr;

  /// Called in addition to `announce`, for the agent that contains this CPU.
  std::function<void()> on_announce;

  /// INTR0 changed at `at`; called by the bench, which watches the pin. May be called while the chip runs ahead of this
  /// agent's turn.
  void intr0_changed(Tick at, bool level);
  /// Ends a `wait_for_wake`, the present or the next one, not before `at`.
  void wake(Tick at);
  /// The program has returned; the CPU does nothing from now on.
  bool ended() const { return fiber_.ended(); }
  const CpuCounters& counters() const { return counters_; }

 private:
  enum class Op : std::uint8_t { kNone, kAccess, kSetRReq, kSetRSta, kLReq, kLSta, kLamps, kWait, kTransfer };
  struct Request {
    Op op = Op::kNone;
    Access access;
    bool level = false;
    Tick until = 0;                ///< kWait
    Transfer* transfer = nullptr;  ///< kTransfer
  };
  /// Events that may end a kWait early.
  enum class Break : std::uint8_t { kInterrupt, kWake, kIntr0 };

  const CpuTiming& timing() const override { return timing_; }
  void set_access_timing(const AccessTiming& read, const AccessTiming& write) override {
    timing_.access = read;
    timing_.write_access = write;
  }
  std::uint8_t read(std::uint16_t address) override;
  void write(std::uint16_t address, std::uint8_t value) override;
  void set_r_req(bool level) override;
  void set_r_sta(bool level) override;
  bool l_req() override;
  bool l_sta() override;
  void looked(const Looks& last) override { looks_ = last; }
  unsigned lamps() override;
  void transfer(Transfer& transfer) override;
  SerialPins& serial_pins() override { return bus_; }
  void transfer_changed() override;
  void skip_to(Tick at) override { now_ = std::max(now_, at); }
  void wait_until(Tick at) override;
  bool wait_for_wake(Tick until) override;
  bool wait_intr0(Tick until) override;
  void on_intr0(std::function<void()> handler) override;
  void enable_interrupts(bool enabled) override;

  void perform(const Request& request);
  bool passes_at_once(Tick at);
  bool made_at_once();
  bool is_over_by_itself() const;
  void suspend_until(Tick at, Break reason);
  void serve_interrupt();
  bool interrupt_is_due() const { return interrupts_open() && interrupt_at_ <= now_; }
  bool interrupts_open() const { return handler_ && enabled_ && !in_handler_; }
  void go_on_transfer();
  void go_on_program();
  bool goes_on(Tick at);
  void take_request();
  void begin_access();
  void run_edges(Tick until);
  void end_access();
  Tick break_tick() const;

  HostBus& bus_;
  CpuTiming timing_;
  CpuCounters counters_;
  std::function<void()> handler_;
  bool enabled_ = true, in_handler_ = false;
  Tick interrupt_at_ = bus::kNever;  ///< since when a falling INTR0 edge waits for its handler
  Tick intr0_at_ = bus::kNever;      ///< a falling edge not yet reported by wait_intr0
  Tick wake_at_ = bus::kNever;
  Request request_;
  Break break_ = Break::kInterrupt;
  bool begun_ = false;          ///< the request, before the program suspended
  bool put_off_ = false;        ///< the present access is put off until its end
  Tick refused_ = bus::kNever;  ///< goes_on() was false for it in this turn
  Tick now_ = 0;
  Tick ready_at_;  ///< when the program continues
  bool sampled_ = false;
  Looks looks_;
  unsigned lamps_ = 0;
  Fiber fiber_;
};

}  // namespace dsdpv1::user_cpu
