#pragma once
// The user CPU's access to the chip: the handshake pins and INTR0, and a DPRAM access that proceeds edge by edge, so
// that other agents act in between and every edge has its exact tick.
#include <cstdint>

#include "bus/time.hpp"
#include "kinds/user_cpu/serial_pins.hpp"
#include "model/dsdpv1/host_access.hpp"

namespace dsdpv1::user_cpu {

struct Access {
  bool write = false;
  std::uint16_t address = 0;  ///< 0..0x7FF
  std::uint8_t value = 0;     ///< for a write
};

/// When the program looked at the pins last; -1: never.
struct Looks {
  Tick l_req = -1, l_sta = -1;
};

/// How the memory controller of a processor waits for the chip's ready.
struct WaitTiming {
  bool on = false;
  bool while_high = false;  ///< it waits as long as NWAIT is high; else low
  std::int64_t hclk_hz = 72'000'000;
};

/// Implemented on the pins of a chip, and by adapters to a socket: such a bus has one edge, the end of the access. A
/// chip without the DSDPV1's handshake has none of its pins.
///
/// Calls come in order of time, all during `bus::Agent::run` of the CPU, on the stack of the bench.
class HostBus : public SerialPins {
 public:
  virtual void set_r_req(Tick /*at*/, bool /*level*/) {}
  virtual void set_r_sta(Tick /*at*/, bool /*level*/) {}
  /// The pins at `at`, after all chip activity up to and including that tick.
  virtual bool l_req(Tick /*at*/) { return false; }
  virtual bool l_sta(Tick /*at*/) { return false; }
  /// Announces, before R_STA rises, the looks that it follows.
  virtual void looked(const Looks& /*last*/) {}
  virtual bool intr0(Tick /*at*/) { return true; }
  /// The lamps' pins at `at`; of a DSDPV1 PBF in bit 0, BR in bit 1, READY in bit 2.
  virtual unsigned lamps(Tick /*at*/) { return 0; }
  /// Whether these calls may come from the stack of the CPU's program.
  virtual bool is_used_from_anywhere() const { return false; }

  /// The user CPU reads a wrong bit once in each kind of block of the chip, or in replies of a serial port. Only by
  /// pins.
  virtual void spoil_reads() {}

  /// From the next access on, of a chip with a ready.
  virtual void set_wait(const WaitTiming& /*wait*/) {}
  /// Begins an access whose first edge is at `at`. Only one runs at a time.
  virtual void begin(Tick at, const Access& access, const AccessTiming& timing) = 0;
  /// The tick of the running access' next edge, `bus::kNever` when all are done.
  virtual Tick next_edge() const = 0;
  /// Returns true if no other agent is concerned by the access just begun until its end: `run_edges` need not be called
  /// before `end()`, even if others act meanwhile. False: each edge at its time.
  virtual bool put_off() { return false; }
  /// Executes the edges due up to `until`, which is not before `next_edge()`, each at its tick; stops after an edge
  /// that is reported to a listener.
  virtual void run_edges(Tick until) = 0;
  /// The tick at which the next access may begin: the last edge plus the recovery time. While the chip is not ready it
  /// may become later.
  virtual Tick end() const = 0;

  /// The value of the last read. 0xFF if `last_read_was_bad()`.
  virtual std::uint8_t read_value() const = 0;
  /// The sampled data were unknown (X) or floating (Z).
  virtual bool last_read_was_bad() const = 0;
};

}  // namespace dsdpv1::user_cpu
