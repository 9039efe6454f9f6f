#pragma once
// The instructions of a Cortex-M3 (ARMv7-M without floating point): registers, memory, the count of time. Exceptions,
// the system control space and what time is for are CortexM3's.
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "board/cpu/debug_target.hpp"
#include "board/cpu/instruction.hpp"

namespace dsdpv1::arm {

/// Called by the engine while it runs. Their exceptions leave Engine::run().
class EngineEvents {
 public:
  virtual ~EngineEvents() = default;
  /// Before the first instruction that begins at Engine::attend_at or later, also one whose condition fails. False: it
  /// is not executed, run() returns.
  virtual bool before_instruction() = 0;
  /// A load or store of 1, 2 or 4 bytes, aligned, in a range of map_events. Engine::bus_error() ends it.
  virtual std::uint32_t on_load(std::uint32_t address, unsigned bytes) = 0;
  virtual void on_store(std::uint32_t address, unsigned bytes, std::uint32_t value) = 0;
  /// An access to mapped memory or outside, while report_data(true).
  virtual void on_data(std::uint32_t address, unsigned bytes, bool write) = 0;
  /// SEV.
  virtual void on_event() = 0;
  /// A store to the range of watch(), done.
  virtual void on_watched_store() = 0;
};

/// All that decides what an Engine does next, except memory.
struct EngineState {
  std::uint32_t pc, xpsr, msp, psp, primask, basepri, faultmask, control;
  std::array<std::uint32_t, 15> r;
  bool exclusive;
  std::uint64_t line_ready;  ///< thousandths of a cycle until flash has the next line
  bool operator==(const EngineState& other) const;
};

/// Why Engine::run() returned.
enum class Trap : std::uint8_t {
  kNone,  ///< before_instruction() wanted it
  // executed: kPc is that of the next instruction
  kSvc,
  kWfi,
  kWfe,
  kExceptionReturn,  ///< kPc is EXC_RETURN without its lowest bit
  // not executed
  kInvalidState,  ///< with EPSR.T 0
  kBreakpoint,
  kNoCoprocessor,
  kUndefined,
  kBadFetch,   ///< no memory is at bad_address(), which is kPc
  kBadAccess,  ///< no memory is at bad_address(), none that may be written, or bus_error()
  kUnaligned,  ///< an address that has to be a multiple of the size
};

/// Cycles until the pipeline is full after a branch whose target is known when it is decoded, when it is executed, or
/// when it has been loaded. The technical reference manual says 1 to 3, and that it depends on this (3.3.1, 15.3).
enum Refill : unsigned { kDecoded = 1, kExecuted = 2, kLoaded = 3 };

/// Not copied, not moved: its instructions point into it.
class Engine {
 public:
  /// `cost`: thousandths of a cycle, if every instruction lasts the same; 0: each what it lasts.
  Engine(EngineEvents& events, std::uint32_t cost);
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// `address` and `size` multiples of 4096; `memory` stays the caller's and is shared with it. At most one is
  /// writable.
  void map(std::uint32_t address, std::uint32_t size, std::uint8_t* memory, bool writable);
  /// Loads and stores there go to on_load and on_store; nothing can be executed.
  void map_events(std::uint32_t address, std::uint32_t size) { windows_.push_back({address, size}); }
  /// Mapped memory, where code may be, was written from outside.
  void forget_code();
  /// With `on` data accesses call on_data, too; slow.
  void report_data(bool on);
  /// Stores there call on_watched_store, except those that report_data reports.
  void watch(std::uint32_t address, std::uint32_t size) { watched_ = {address, size}; }
  /// Cycles that a read of memory that cannot be written waits; with `prefetches` the line that follows is fetched
  /// while one is executed.
  void set_flash(unsigned wait_states, bool prefetches);
  /// As given; 0 where every instruction lasts the same.
  unsigned wait_states() const { return static_cast<unsigned>(flash_wait_ / 1000); }

  /// In any mode of the processor.
  std::uint32_t read(Register which) const;
  void write(Register which, std::uint32_t value);
  /// Mode, flags and stack pointers at once, as exceptions change them.
  void set_mode(std::uint32_t xpsr, std::uint32_t control, std::uint32_t msp, std::uint32_t psp);
  /// Exceptions end what LDREX has begun (A3.4).
  void clear_exclusive() { exclusive_ = false; }
  bool privileged() const { return ipsr_ != 0 || (control_ & kNotPrivileged) == 0; }

  /// Executes from kPc on.
  Trap run();
  /// From on_load and on_store: nothing answers at this address.
  void bus_error() { access_failed_ = true; }
  bool access_failed() const { return access_failed_; }
  std::uint32_t bad_address() const { return bad_address_; }
  /// The address of the instruction that made Trap::kExceptionReturn.
  std::uint32_t returned_at() const { return returned_at_; }

  /// Thousandths of a cycle: when the instruction at work began; between two, when the next one does.
  std::uint64_t now() const { return now_; }
  void set_now(std::uint64_t time) { executed_ = now_ = time; }
  /// When before_instruction() is called next.
  std::uint64_t attend_at() const { return attend_at_; }
  void attend_at(std::uint64_t time) {
    attend_at_ = time;
    until_ = 0;  // checked before the next instruction
  }
  /// Time that an exception has cut off an instruction, and that follows the return.
  struct Rest {
    std::uint64_t time = 0;  ///< thousandths of a cycle
    bool restarts = false;   ///< all of it again if it is broken off once more
  };
  /// From when on the instruction executed last lets an exception in: it can be broken off, or nothing but the fetch of
  /// the next one is left. now(): it does not. Only between two instructions.
  std::uint64_t gives_way_at() const;
  /// The rest of it after an exception that begins at `time`, from gives_way_at() to now().
  Rest rest(std::uint64_t time) const;
  /// To a time from gives_way_at() on; the instruction executed last stays the same.
  void turn_to(std::uint64_t time) { now_ = time; }
  /// The rest begins now.
  void resume(const Rest& rest);
  EngineState state() const;
  /// With `on` has_stored() tells of stores to memory from now on.
  void look_at_stores(bool on);
  /// There was one since then.
  bool has_stored() const { return has_stored_; }
  /// A stretch of `time` and `instructions` happens again so many times.
  void repeat(std::uint64_t times, std::uint64_t time, std::uint64_t instructions);
  /// Instructions begun, those too whose condition failed.
  std::uint64_t instructions() const { return instructions_ + (running_ ? 1 : 0); }

 private:
  friend struct Operations;

  static constexpr std::uint32_t kPageBytes = 64 * 1024;
  static constexpr unsigned kLineBits = 3, kWordBits = 2;  ///< flash gives 8 bytes at once with prefetch, 4 without
  static constexpr std::uint32_t kNotPrivileged = 1, kSpSel = 2;

  /// Instructions of a page of memory by their halfwords, and two after it, since a long one may begin in its last
  /// halfword. None: not executed yet.
  struct CodePage {
    std::uint32_t start = 0, bytes = 0;
    bool in_flash = false;
    std::unique_ptr<Instruction[]> instructions;
  };
  struct Memory {
    std::uint32_t start, size;
    std::uint8_t* bytes;
    bool writable;
    std::vector<CodePage> pages;
  };
  struct Window {
    std::uint32_t start, size;
  };
  /// Memory that is reached at once: a word at an offset below `limit`.
  struct Direct {
    std::uint32_t start = 0, limit = 0;
    std::uint8_t* bytes = nullptr;
  };

  // --- what comes next
  bool before_next();
  void run_block(bool passes);
  void leave_block() { until_ = 0; }
  void execute_in_block();
  void skip();
  bool at_end_of_page() const;
  bool goes_on() const { return now_ < until_ && !at_end_of_page(); }
  void pay(const Instruction& of) {
    executed_ = now_ += of.cost;
    ++instructions_;
  }
  void pass(const Instruction& what) {
    at_ = &what + what.halfwords;
    if (what.ends_line) next_line();
  }
  /// The instruction at work was executed.
  [[gnu::always_inline]] void done(const Instruction& what) {
    pay(what);
    pass(what);
  }
  /// It began at `since`, and an exception could have broken it off: then it begins again, or resumes where it was.
  void done(const Instruction& what, std::uint64_t since, bool restarts) {
    pay(what);
    breakable(since, restarts);
    pass(what);
  }
  /// It takes `cycles` more.
  void spend(unsigned cycles) { now_ += std::uint64_t{cycles} * cycle_; }
  /// The next instruction is at an even `target`.
  void go(std::uint32_t target, Refill refill) {
    const std::uint32_t last = pc() + 2 * (at_->halfwords - 1U), offset = target - page_->start;
    if (offset >= page_->bytes) return go_far(target, last, refill);
    at_ = &page_->instructions[offset / 2];
    arrive(reach(last, target), refill);
  }
  void go_far(std::uint32_t target, std::uint32_t last, Refill refill);
  /// It is the target of `branch`.
  [[gnu::always_inline]] void follow(const Instruction& branch, Refill refill) {
    if (branch.shift == kFar) return go(branch.value, refill);
    at_ = &branch + static_cast<std::int32_t>(branch.value);
    arrive(static_cast<Reach>(branch.shift), refill);
  }
  [[gnu::always_inline]] void arrive(Reach reach, Refill refill) {
    spend(refill);
    if (at_->entry != Entry::kPlain) return enter_split(reach, refill);
    if (reach != kSameLine) fetch_target(reach);
  }
  /// Of `target` for a branch whose last halfword is at `last`.
  Reach reach(std::uint32_t last, std::uint32_t target) const {
    const std::uint32_t lines = (target >> line_bits_) - (last >> line_bits_);
    return line_wait_ == 0 ? kSameLine : lines < kOtherLine ? static_cast<Reach>(lines) : kOtherLine;
  }
  void enter_split(Reach reach, Refill refill);
  void fetch_target(Reach reach);
  void next_line();
  void read_flash();
  void turn_page(std::uint32_t target);
  void leave_memory(std::uint32_t pc);
  void make_page(const Memory& memory, CodePage& page, std::uint32_t offset);
  /// BXWritePC (ARMv7-M, A2.3.1): a change of state, or the return from an exception.
  void exchange(std::uint32_t target, Refill refill);
  void return_by(std::uint32_t exc_return);
  void set_thumb(std::uint32_t target) {
    thumb_ = (target & 1U) != 0;
    if (!thumb_) trap(Trap::kInvalidState);
  }
  /// Ends run(), the instruction at work executed or not.
  void trap(Trap why) {
    trap_ = why;
    until_ = 0;
  }
  void refuse(Trap why) {
    pay(*at_);
    trap(why);
  }
  std::uint32_t pc() const { return page_->start + static_cast<std::uint32_t>(at_ - page_->instructions.get()) * 2; }
  Instruction decode_at(std::uint32_t address);
  void decode_here();
  /// Replaces the target of a branch at `here` by the way there, if that is in the page.
  void aim(Instruction& branch, std::uint32_t here) const;

  // --- memory; false: a trap, the instruction is to be left as it is
  template <unsigned bytes>
  [[gnu::always_inline]] bool load(std::uint32_t address, std::uint32_t& value);
  template <unsigned bytes>
  [[gnu::always_inline]] bool store(std::uint32_t address, std::uint32_t value);
  /// `bytes` of memory that is reached at once; nullptr: not all of them are.
  static std::uint8_t* all_of(const Direct& memory, std::uint32_t address, std::uint32_t bytes) {
    const std::uint32_t offset = address - memory.start;
    return offset < memory.limit && memory.limit - offset >= bytes ? memory.bytes + offset : nullptr;
  }
  bool load_elsewhere(std::uint32_t address, unsigned bytes, std::uint32_t& value);
  bool store_elsewhere(std::uint32_t address, unsigned bytes, std::uint32_t value);
  bool load_part(std::uint32_t address, unsigned bytes, std::uint32_t& value);
  bool store_part(std::uint32_t address, unsigned bytes, std::uint32_t value);
  bool fail(std::uint32_t address);
  /// False, and a trap, unless `address` is a multiple of `bytes`.
  bool aligned(std::uint32_t address, unsigned bytes) {
    if (address % bytes != 0) refuse(Trap::kUnaligned);
    return address % bytes == 0;
  }
  void breakable(std::uint64_t since, bool restarts, bool jumps = false) {
    breakable_since_ = since;
    breakable_until_ = now_;
    restarts_ = restarts;
    jumps_ = jumps;
  }
  Memory* memory_at(std::uint32_t address);
  bool is_window(std::uint32_t address) const;
  bool is_watched(std::uint32_t address, std::uint32_t bytes) const {
    return address - watched_.start < watched_.size || watched_.start - address < bytes;
  }
  void forget_code(const Memory& memory, std::uint32_t address, unsigned bytes);
  void set_direct();

  // --- registers
  bool uses_psp() const { return ipsr_ == 0 && (control_ & kSpSel) != 0; }
  void bank_out() { (uses_psp() ? psp_ : msp_) = r_[13]; }
  void bank_in() { r_[13] = uses_psp() ? psp_ : msp_; }
  std::uint32_t xpsr() const;
  void set_flags(std::uint32_t apsr);
  void set_xpsr(std::uint32_t value);
  /// MRS and MSR (B5.2.2, B5.2.3).
  std::uint32_t read_special(unsigned which) const;
  void write_special(unsigned which, bool flags, std::uint32_t value);
  bool passes(unsigned condition) const;

  EngineEvents& events_;
  const std::uint32_t cost_;   ///< of every instruction; 0: its own
  const std::uint32_t cycle_;  ///< thousandths of a cycle that a further one takes: 1000, or 0
  std::vector<Memory> memories_;
  std::vector<Window> windows_;
  Direct loads_, stores_, constants_;  ///< RAM, RAM without code, flash
  bool reports_data_ = false, ram_has_code_ = false;
  bool looks_at_stores_ = false, has_stored_ = false;
  CodePage nowhere_;        ///< where no memory is
  Memory* code_ = nullptr;  ///< that instructions came from last
  Window watched_ = {};
  // Thousandths of a cycle: what a read of flash waits, what the fetch of instructions does here; when the line is
  // there that follows.
  std::uint64_t flash_wait_ = 0, line_wait_ = 0, line_ready_ = 0;
  unsigned line_bits_ = kLineBits;  ///< of an address inside of what is fetched at once
  bool prefetches_ = true;

  const CodePage* page_ = nullptr;
  const Instruction* at_ = nullptr;  ///< at work, or next
  std::uint64_t now_ = 0, until_ = 0, attend_at_ = 0, instructions_ = 0;
  // The end of the last instruction, without the fetch of the next one; the last instruction that could be broken off,
  // whether it begins again, and whether that fetch is part of it; the end of the last access outside.
  std::uint64_t executed_ = 0, breakable_since_ = 0, breakable_until_ = 0, accessed_ = 0;
  bool restarts_ = false, jumps_ = false;
  Trap trap_ = Trap::kNone;
  bool running_ = false, access_failed_ = false;
  std::uint32_t bad_address_ = 0, returned_at_ = 0;

  std::array<std::uint32_t, 16> r_{};                                 ///< r15 only for instructions that look at it
  std::uint32_t negative_ = 0, zero_ = 1, carry_ = 0, overflow_ = 0;  ///< N: bit 31; Z: of 0; C and V: 0 or 1
  bool saturated_ = false, thumb_ = true, exclusive_ = false;
  std::uint8_t it_ = 0;  ///< ITSTATE
  std::uint32_t ipsr_ = 0, msp_ = 0, psp_ = 0, primask_ = 0, basepri_ = 0, faultmask_ = 0, control_ = 0;
};

/// A7.3.1. Here, since of most instructions the condition is known when they are compiled.
inline bool Engine::passes(unsigned condition) const {
  const bool n = (negative_ & (1U << 31)) != 0, v = overflow_ != 0;
  bool right = true;
  switch (condition >> 1U) {
    case 0: right = zero_ == 0; break;
    case 1: right = carry_ != 0; break;
    case 2: right = n; break;
    case 3: right = v; break;
    case 4: right = carry_ != 0 && zero_ != 0; break;
    case 5: right = n == v; break;
    case 6: right = zero_ != 0 && n == v; break;
    default: return true;
  }
  return right != ((condition & 1U) != 0);
}

}  // namespace dsdpv1::arm
