#pragma once
// A Cortex-M3 (ARMv7-M) in simulated time: Engine executes the instructions; exceptions and the system control space
// stand here. Instructions last what the technical reference manual says, accesses to the System what the System says.
// An exception breaks off LDM, STM, divisions and long multiplications; registers and memory are as if they had been
// executed, and the rest of their time follows the return. Not modelled: the MPU, unaligned-access and division-by-zero
// traps (CCR), ICI. An unaligned access to the System comes in aligned parts.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "board/cpu/debug_target.hpp"
#include "board/cpu/engine.hpp"
#include "board/cpu/fault.hpp"
#include "board/cpu/nvic.hpp"
#include "board/cpu/polling.hpp"
#include "board/cpu/scb.hpp"
#include "board/cpu/systick.hpp"

namespace dsdpv1::arm {

/// Everything outside of the processor that is neither flash, RAM nor its own registers: 0x1FFFF000 to 0x1FFFFFFF,
/// 0x40000000 to 0xDFFFFFFF, and the parts of 0xE0000000 to 0xE00FFFFF that the core lacks (DBGMCU, ITM). The functions
/// may throw: the exception leaves CortexM3::run().
class System {
 public:
  virtual ~System() = default;
  /// A load or store of `bytes` (1, 2 or 4) that begins at cycles(). The system spends what it takes with
  /// CortexM3::advance_to.
  virtual std::uint32_t load(std::uint32_t address, unsigned bytes) = 0;
  virtual void store(std::uint32_t address, unsigned bytes, std::uint32_t value) = 0;
  /// Between two instructions: the rest of the world comes up to cycles(); may call set_interrupt. Returns the cycle of
  /// the next call (kNever: none); after every load and store it is called again.
  virtual std::uint64_t keep_up() = 0;
  /// Passes of a loop were left out (Timing::leaves_out_polls): each load after cycle `since` was made again, for the
  /// last time `cycles` later.
  virtual void left_out(std::uint64_t /*since*/, std::uint64_t /*cycles*/) {}
  /// WFI or WFE with nothing pending: lets time pass until set_interrupt was called or cycle `until` (kNever: none) has
  /// come; the system calls advance_to.
  virtual void sleep(std::uint64_t until) = 0;
  /// The handler of external interrupt `irq` has returned at `pc` kStorm times, and its source was never low.
  virtual void storm(unsigned /*irq*/, std::uint32_t /*pc*/) {}
  static constexpr unsigned kStorm = 100;
  /// AIRCR.SYSRESETREQ or a debugger's reset: the peripherals fall back to their state after reset; the processor
  /// starts again at its vector table.
  virtual void reset() {}
  /// The aligned word at `address` as a debugger sees it: no time passes, no pin moves, nothing is cleared. nullopt:
  /// nothing is there.
  virtual std::optional<std::uint32_t> peek(std::uint32_t /*address*/) const { return std::nullopt; }
  /// Where peek() finds something.
  virtual std::vector<MemoryRegion> regions() const { return {}; }
  /// Simulated time, for a debugger.
  virtual bus::Tick now() const { return 0; }
};

/// Cycles of HCLK (Cortex-M3 technical reference manual r2p0, 3.9.1).
struct Timing {
  std::uint32_t millicycles_per_instruction = 0;  ///< 0: each what it lasts; else all the same
  std::uint32_t exception_entry = 12;             ///< the handler's first instruction is fetched meanwhile
  std::uint32_t exception_return = 12;            ///< the next instruction is fetched meanwhile
  std::uint32_t tail_chain = 6;                   ///< in place of a return and an entry; without wait states
  bool leaves_out_polls = true;                   ///< see Polling; nothing is different but the time that a run takes
};

/// Sizes are multiples of 4096 bytes. Flash is seen at 0 too.
struct MemoryMap {
  std::uint32_t flash_base = 0x08000000, flash_size = 512 * 1024;
  std::uint32_t ram_base = 0x20000000, ram_size = 64 * 1024;
};

class CortexM3 : public DebugTarget, private EngineEvents {
 public:
  /// `system` has to outlive this.
  CortexM3(System& system, const MemoryMap& map, const Timing& timing);
  ~CortexM3() override;
  CortexM3(const CortexM3&) = delete;
  CortexM3& operator=(const CortexM3&) = delete;

  /// Into flash or RAM, before or during the run. Throws std::out_of_range outside of both.
  void load(std::uint32_t address, const std::uint8_t* bytes, std::size_t count);
  /// Host memory of the RAM, for the bench's mailbox.
  std::uint8_t* ram() { return ram_; }

  /// From reset (SP and PC from the vector table) until stop(). Throws FaultError when a fault ends the run, and what
  /// System throws.
  void run();
  /// The run ends before the next instruction. Callable from System's functions and on_fault.
  void stop();

  /// Flash from now on; at first without wait states.
  void set_flash(unsigned wait_states, bool prefetches) { engine_.set_flash(wait_states, prefetches); }
  /// System::keep_up is called after each store to this part of RAM.
  void watch(std::uint32_t address, std::uint32_t size) { engine_.watch(address, size); }
  /// Cycles of HCLK since the first reset.
  std::uint64_t cycles() const { return engine_.now() / kMillis; }
  /// From System's functions: time has gone on. Not backwards.
  void advance_to(std::uint64_t cycle);
  /// Instructions executed, those too whose condition failed.
  std::uint64_t instructions() const override { return engine_.instructions(); }
  /// The address of the instruction at work; between two, of the next one.
  std::uint32_t pc() const { return engine_.read(Register::kPc); }
  /// The same, but during the return from an exception the instruction that returned.
  std::uint32_t place() const { return pc() < 0xF000'0000 ? pc() : engine_.returned_at(); }

  /// External interrupt 0 to 67 becomes pending.
  void set_interrupt(unsigned irq);
  /// The RXEV pin: an event from outside, which ends a WFE (B1.5.18).
  void signal_event() { event_ = true; }
  /// Level-sensitive source: pending again after return while high.
  void set_interrupt_level(unsigned irq, bool high);
  /// From System::load and store: nothing answers at this address; the access ends with a bus fault.
  void bus_error();
  /// From System::load, which has come up to cycles(): once more it would do nothing else before cycle `until`, where
  /// keep_up is due.
  void stays(std::uint64_t until);

  Registers registers() const;
  /// Called for each fault once, also when the firmware handles it.
  void on_fault(std::function<void(const Fault&)> report) { report_fault_ = std::move(report); }
  /// nullptr: none. Not while it runs.
  void attach(Debugger* debugger) { debugger_ = debugger; }

  std::uint32_t read_register(Register which) const override;
  void write_register(Register which, std::uint32_t value) override;
  std::vector<MemoryRegion> memory_map() const override;
  std::size_t read_memory(std::uint32_t address, std::uint8_t* to, std::size_t count) const override;
  bool write_memory(std::uint32_t address, const std::uint8_t* from, std::size_t count) override;
  bool report_data_accesses(bool on) override;
  bool reset() override;
  bus::Tick now() const override { return system_.now(); }
  void end_run() override { stop(); }
  bool asleep() const override { return asleep_; }

 private:
  static constexpr std::uint64_t kMillis = 1000;
  static constexpr std::uint64_t millis(std::uint64_t cycle) { return cycle == kNever ? kNever : cycle * kMillis; }

  // cortex_m3.cpp: memory, time, the run
  void map_memory();
  void reset_processor();
  void advance_run();
  void handle_trap(Trap trap);
  void between_instructions();
  void attend_soon() { engine_.attend_at(0); }
  void attend_to_world();
  void attend_debugger();
  void catch_up();
  void catch_up_systick();
  bool gives_way();
  void schedule();
  void leave_out_passes();
  void step_towards(std::uint64_t end);
  std::uint64_t due() const { return std::min(keep_up_at_, millis(systick_.next())); }
  bool is_due() const { return engine_.now() >= keep_up_at_; }
  void doze(bool for_event);
  const std::uint8_t* host(std::uint32_t address) const;
  std::uint16_t opcode_at(std::uint32_t address) const;
  std::uint32_t word_at(std::uint32_t address) const;
  bool executable(std::uint32_t address) const { return host(address) != nullptr; }
  bool in_ram(std::uint32_t address, std::uint32_t count) const;

  // EngineEvents
  bool before_instruction() override;
  std::uint32_t on_load(std::uint32_t address, unsigned bytes) override;
  void on_store(std::uint32_t address, unsigned bytes, std::uint32_t value) override;
  void on_data(std::uint32_t address, unsigned bytes, bool write) override;
  void on_event() override { event_ = true; }
  void on_watched_store() override { attend_to_world(); }

  // private_bus.cpp: bit-band, system control space
  std::uint32_t load_outside(std::uint32_t address, unsigned bytes);
  void store_outside(std::uint32_t address, unsigned bytes, std::uint32_t value);
  std::uint32_t load_bit(std::uint32_t alias, unsigned bytes);
  void store_bit(std::uint32_t alias, unsigned bytes, bool value);
  std::uint32_t load_band(std::uint32_t address, unsigned bytes);
  void store_band(std::uint32_t address, unsigned bytes, std::uint32_t value);
  std::uint32_t load_private(std::uint32_t address, unsigned bytes);
  void store_private(std::uint32_t address, unsigned bytes, std::uint32_t value);
  std::uint32_t load_control_word(std::uint32_t offset);
  void store_control_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes);

  // exceptions.cpp: entry, return, faults
  unsigned preempting() const;
  Nvic::Masks masks() const;
  unsigned handler() const;
  void take_exception(std::uint32_t return_address, const Engine::Rest& rest = {});
  void enter(std::uint32_t cycles, std::uint32_t exc_return);
  std::uint32_t chain_cycles() const;
  void activate(unsigned exception, std::uint32_t exc_return);
  std::uint32_t push_frame(std::uint32_t return_address);
  void write_frame(std::uint32_t sp, std::uint32_t return_address, std::uint32_t xpsr);
  void chain_fault(FaultKind kind, std::uint32_t address, std::uint32_t exc_return);
  FaultOutcome outcome(unsigned fault_handler, int priority) const;
  void end_handler(unsigned exception);
  void return_from_exception();
  void unstack(std::uint32_t exc_return);
  bool return_allowed(std::uint32_t exc_return) const;
  void enter_mode(std::uint32_t xpsr, std::uint32_t control, std::uint32_t msp, std::uint32_t psp);
  void supervisor_call();
  void raise(FaultKind kind, std::uint32_t address);
  void pend_fault(FaultKind kind, std::uint32_t pc, std::uint32_t address);
  unsigned record(FaultKind kind, std::uint32_t address);
  void continue_at(std::uint32_t target);

  System& system_;
  MemoryMap map_;
  Timing timing_;
  std::unique_ptr<std::uint8_t[]> memory_;  // flash and RAM, each on a page of the host
  std::uint8_t* flash_ = nullptr;
  std::uint8_t* ram_ = nullptr;
  Engine engine_;
  Polling polling_{engine_};
  bool stays_ = false;    ///< what the load at work, or the last one, has found
  bool has_met_ = false;  ///< the instruction at work has met the world, which may have changed by that

  Nvic nvic_;
  SysTick systick_;
  Scb scb_;

  // Thousandths of a cycle.
  std::uint64_t keep_up_at_ = 0;
  Engine::Rest rest_;                                         // of the instruction that the next exception breaks off
  std::array<Engine::Rest, Nvic::kExceptions> broken_off_{};  // of others, by the exceptions that were active
  bool event_ = false;                                        // the event register of WFE and SEV (B1.5.18)
  bool stopped_ = false, reset_requested_ = false;
  bool moved_ = false;   // a debugger wrote PC
  bool asleep_ = false;  // while a debugger is asked

  std::function<void(const Fault&)> report_fault_;
  Debugger* debugger_ = nullptr;
  std::uint64_t poll_at_ = 0;  // thousandths of a cycle
};

}  // namespace dsdpv1::arm
