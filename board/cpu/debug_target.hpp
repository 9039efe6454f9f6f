#pragma once
// Where processor and debugger meet: the processor implements DebugTarget and calls Debugger. One thread; calls of
// either kind, data_access() apart, are made between two instructions, when the registers are those of the one that
// comes next.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bus/time.hpp"

namespace dsdpv1::arm {

/// The registers of a Cortex-M3 (ARMv7-M, B1.4), numbered as in gdb's target description.
enum class Register : std::uint8_t {
  kR0 = 0,
  kR12 = 12,  ///< r1 to r11 stand between
  kSp,        ///< the one of kMsp and kPsp that is in use
  kLr,
  kPc,    ///< address of the next instruction, without Thumb bit
  kXpsr,  ///< APSR, IPSR, EPSR together; T is set
  kMsp,
  kPsp,
  kPrimask,    ///< 0 or 1
  kBasepri,    ///< 0 to 255
  kFaultmask,  ///< 0 or 1
  kControl,    ///< 0 to 3
};
constexpr unsigned kRegisterCount = 23;

/// A range of addresses that gdb may look at. Everything else it takes for empty.
struct MemoryRegion {
  std::uint32_t start;
  std::uint32_t size;      ///< bytes, > 0
  bool writable;           ///< false: gdb sets hardware breakpoints in it
  std::uint32_t page = 0;  ///< of flash: bytes that are erased at once; 0: no flash
};

/// The processor as a debugger wants it. No call takes simulated time and none has an effect on the run that is not
/// asked for: reading a peripheral clears no flag and moves no pin. A register for which that is impossible counts as
/// not readable.
class DebugTarget {
 public:
  virtual ~DebugTarget() = default;

  virtual std::uint32_t read_register(Register which) const = 0;
  /// Also of kPc (bit 0 is clear): the run continues there.
  virtual void write_register(Register which, std::uint32_t value) = 0;

  virtual std::vector<MemoryRegion> memory_map() const = 0;
  /// Copies `count` bytes from `address`; returns how many could be read, from the first on.
  virtual std::size_t read_memory(std::uint32_t address, std::uint8_t* to, std::size_t count) const = 0;
  /// False, and nothing written, when one of the bytes cannot be: flash is not writable, the run's firmware is that of
  /// the scenario.
  virtual bool write_memory(std::uint32_t address, const std::uint8_t* from, std::size_t count) = 0;

  /// From now on data accesses are reported by Debugger::data_access(), or no longer. False: it cannot, there are no
  /// watchpoints.
  virtual bool report_data_accesses(bool on) = 0;

  /// As a system reset of the processor and its peripherals (AIRCR.SYSRESETREQ) before the next instruction, which is
  /// then the reset handler's first and the next that before_instruction() is called for; the chip is not touched.
  /// False: it cannot.
  virtual bool reset() = 0;
  /// Simulated time.
  virtual bus::Tick now() const = 0;
  /// Instructions begun since the processor was made, the one included that before_instruction() is called for.
  virtual std::uint64_t instructions() const = 0;
  /// In WFI or WFE: the last one begun is executed already.
  virtual bool asleep() const { return false; }
  /// gdb's `kill`: the run ends before the next instruction.
  virtual void end_run() = 0;
};

/// The debugger as the processor calls it. Simulated time stands still in each call, however long the user thinks.
class Debugger {
 public:
  virtual ~Debugger() = default;

  /// True: before_instruction() must be called for every instruction. Changes in calls of this class, and with the time
  /// while earlier changes by a debugger are repeated: look after each of poll() and before_instruction(), and about
  /// every 250 ns of simulated time. While false, poll() now and then is enough and the processor may run as
  /// fast as it can; while true, before_instruction() does what poll() does.
  virtual bool wanted() const = 0;
  /// Before each instruction, those of handlers too; returns when it may be executed. Meanwhile registers (kPc!) and
  /// memory may have been changed and end_run() or reset() called; with another kPc it may be called again before the
  /// instruction there, or not. Costs a few nanoseconds when nothing stops the run.
  virtual void before_instruction(std::uint32_t pc) = 0;
  /// An access of the instruction that is being executed, after report_data_accesses(true). Never halts: the run stops
  /// before the next instruction. `size` is 1, 2 or 4 bytes. Instruction fetches and the debugger's own accesses are
  /// not meant.
  virtual void data_access(std::uint32_t address, std::uint32_t size, bool write) = 0;
  /// Looks for gdb: whether it connects, wants a halt (Ctrl-C), has gone. To be called now and then between
  /// instructions, about every 10 ms of real time, also while the processor sleeps (WFI); a system call. Returns at
  /// once unless gdb wants the processor halted; then like before_instruction().
  virtual void poll() = 0;
  /// The processor cannot continue: a fault without a handler, in words. Halts so that the user can look, when gdb is
  /// attached; the run ends when it returns.
  virtual void fault(const std::string& what) = 0;
};

}  // namespace dsdpv1::arm
