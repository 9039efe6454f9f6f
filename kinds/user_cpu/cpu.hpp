#pragma once
// The interface for a program on the user CPU. Calls take simulated time where noted; meanwhile the rest of the bench
// continues.
#include <cstdint>
#include <functional>
#include <optional>

#include "kinds/user_cpu/host_bus.hpp"
#include "kinds/user_cpu/transfer.hpp"

namespace dsdpv1::user_cpu {

/// Speed of the CPU. Ticks of 1/12 ns, none negative. The defaults are those of a Cortex-M3 at 72 MHz.
struct CpuTiming {
  AccessTiming access;
  /// For writes, if they differ from reads in more than the strobe.
  std::optional<AccessTiming> write_access;
  Tick overhead = 1000;           ///< instructions between two accesses: 6 cycles, 83.3 ns
  Tick pin_sample = 210;          ///< reading one handshake pin: 17.5 ns
  Tick pin_write = 167;           ///< setting one handshake pin: 1 cycle, 13.9 ns
  Tick r_req_to_sample = 1200;    ///< H2: minimum time from R_REQ's rise to the first sample of L_REQ: 100 ns
  Tick r_req_to_r_sta = 2040;     ///< H2: minimum time from R_REQ's rise to R_STA's: 170 ns
  Tick interrupt_latency = 4000;  ///< INTR0's fall to the handler's first instruction: 24 cycles, 333 ns
  Tick poll_interval = 120'000;   ///< pause between two polls of the DPRAM: 10 us
};

/// The program's view of the CPU. Methods are called from the program (or its interrupt handler) only.
class Cpu {
 public:
  virtual ~Cpu() = default;

  virtual Tick now() const = 0;
  virtual const CpuTiming& timing() const = 0;
  /// From the next access on.
  virtual void set_access_timing(const AccessTiming& read, const AccessTiming& write) = 0;

  /// One DPRAM access with the timing's edges, then the overhead. A bad read (X or Z sampled) returns 0xFF and is
  /// counted.
  virtual std::uint8_t read(std::uint16_t address) = 0;
  virtual void write(std::uint16_t address, std::uint8_t value) = 0;

  /// The pin changes at once; the call takes `pin_write`.
  virtual void set_r_req(bool level) = 0;
  virtual void set_r_sta(bool level) = 0;
  /// The pin is sampled at once; the call takes `pin_sample`.
  virtual bool l_req() = 0;
  virtual bool l_sta() = 0;
  /// Replaces the times of the last calls of these two, for a program that is not what looks.
  virtual void looked(const Looks& last) = 0;
  /// As above for the lamps' pins, see HostBus::lamps.
  virtual unsigned lamps() = 0;

  /// Waits until the transfer, which has begun, is done; then the overhead passes. Interrupts are served afterwards.
  virtual void transfer(Transfer& transfer) = 0;
  /// The chip's pins of the serial ports, for use by a transfer.
  virtual SerialPins& serial_pins() = 0;
  /// `Transfer::next` of the present one may have changed.
  virtual void transfer_changed() = 0;

  /// It is `at` now: the caller knows that nothing happens before.
  virtual void skip_to(Tick at) = 0;
  /// Waits; interrupts are served meanwhile, and their time counts.
  virtual void wait_until(Tick at) = 0;
  void wait(Tick ticks) { wait_until(now() + ticks); }
  /// Like `wait_until`, but also returns when the bench calls `NativeCpu::wake`. False if `until` came first.
  virtual bool wait_for_wake(Tick until) = 0;
  /// Waits for a falling edge of INTR0 after the one reported by the previous call; false if `until` came first.
  virtual bool wait_intr0(Tick until) = 0;

  /// `handler` runs `interrupt_latency` after INTR0 fell, between two instructions, nested in the program. While the
  /// handler runs or interrupts are disabled it is deferred until right afterwards. Further edges meanwhile count once.
  /// Null: none.
  virtual void on_intr0(std::function<void()> handler) = 0;
  virtual void enable_interrupts(bool enabled) = 0;
};

}  // namespace dsdpv1::user_cpu
