#include "board/cpu/engine.hpp"

#include <algorithm>
#include <cstring>
#include <tuple>
#include <utility>

#include "board/cpu/operations.hpp"

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kNegative = 1U << 31, kZero = 1U << 30, kCarry = 1U << 29, kOverflow = 1U << 28,
                        kSaturated = 1U << 27, kThumb = 1U << 24, kException = 0x1FF, kFlags = 0xF8000000;
constexpr std::uint32_t kCycle = 1000;
constexpr std::uint32_t kItLow = 25, kItHigh = 10;  // where its bits 1..0 and 7..2 stand in EPSR
constexpr Instruction kNotDecoded = {&Operations::not_decoded, &Operations::not_decoded_in_it};
constexpr Instruction kNextPage = {&Operations::next_page, &Operations::next_page};
constexpr Instruction kNoMemory = {&Operations::no_memory, &Operations::no_memory};
constexpr std::size_t kLongestBlock = 4;  // where no memory is, its instructions whose condition fails are passed

/// It is decoded again; if it is at work, it still ends as it began.
void forget(Instruction& instruction) {
  instruction.run = kNotDecoded.run;
  instruction.run_in_it = kNotDecoded.run_in_it;
  instruction.entry = Entry::kUnknown;
}

/// ITSTATE of the instruction that follows (A7.3.2).
std::uint8_t following(std::uint8_t state) {
  if ((state & 7U) == 0) return 0;
  return static_cast<std::uint8_t>((state & 0xE0U) | (unsigned{state} << 1U & 0x1FU));
}

}  // namespace

Engine::Engine(EngineEvents& events, std::uint32_t cost)
    : events_(events), cost_(cost), cycle_(cost == 0 ? kCycle : 0) {
  nowhere_.instructions = std::make_unique<Instruction[]>(kLongestBlock);
  std::fill_n(nowhere_.instructions.get(), kLongestBlock, kNoMemory);
  leave_memory(0);
}

Engine::~Engine() = default;

// --- what comes next

Trap Engine::run() {
  struct Running {
    bool& flag;
    ~Running() { flag = false; }
  } const ends{running_};
  running_ = true;
  trap_ = thumb_ ? Trap::kNone : Trap::kInvalidState;
  while (trap_ == Trap::kNone && before_next()) {
    until_ = attend_at_;
    if (it_ != 0) {
      run_block(true);
      continue;
    }
    do at_->run(*this, *at_);
    while (now_ < until_);
  }
  return trap_;
}

/// An instruction whose condition fails takes its time, too.
bool Engine::before_next() {
  for (;;) {
    if (at_end_of_page()) turn_page(pc());
    if (now_ >= attend_at_ && !events_.before_instruction()) return false;
    if (it_ == 0 || passes(it_ >> 4U)) return true;
    skip();
  }
}

/// The instruction in an IT block whose condition fails.
inline void Engine::skip() {
  if (at_->run == kNotDecoded.run) decode_here();
  executed_ = now_ += cost_ != 0 ? cost_ : kCycle;
  ++instructions_;
  pass(*at_);
  it_ = following(it_);
}

/// The part of an IT block that needs no call of before_instruction(). `passes`: the first condition.
void Engine::run_block(bool passes) {
  for (;; passes = this->passes(it_ >> 4U)) {
    if (passes)
      execute_in_block();
    else
      skip();
    if (it_ == 0) return;
    if (!goes_on()) return leave_block();
  }
}

inline void Engine::execute_in_block() {
  const std::uint8_t state = it_;
  at_->run_in_it(*this, *at_);
  if (trap_ <= Trap::kInvalidState) it_ = following(state);
}

void Engine::go_far(std::uint32_t target, std::uint32_t last, Refill refill) {
  turn_page(target);
  arrive(reach(last, target), refill);
}

void Engine::turn_page(std::uint32_t target) {
  if (code_ == nullptr || target - code_->start >= code_->size) code_ = memory_at(target);
  if (code_ != nullptr) {
    const std::uint32_t offset = target - code_->start;
    CodePage& page = code_->pages[offset / kPageBytes];
    if (!page.instructions) make_page(*code_, page, offset & ~(kPageBytes - 1));
    page_ = &page;
    at_ = &page.instructions[offset % kPageBytes / 2];
    line_wait_ = page_->in_flash ? flash_wait_ : 0;
  } else {
    leave_memory(target);
  }
}

void Engine::leave_memory(std::uint32_t pc) {
  nowhere_.start = pc;
  page_ = &nowhere_;
  at_ = page_->instructions.get();
  line_wait_ = 0;
}

void Engine::make_page(const Memory& memory, CodePage& page, std::uint32_t offset) {
  page.start = memory.start + offset;
  page.bytes = std::min(kPageBytes, memory.size - offset);
  page.in_flash = !memory.writable;
  page.instructions.reset(new Instruction[page.bytes / 2 + 2]);
  std::fill_n(page.instructions.get(), page.bytes / 2, kNotDecoded);
  std::fill_n(&page.instructions[page.bytes / 2], 2, kNextPage);
  if (memory.writable) {
    ram_has_code_ = true;
    set_direct();
  }
}

/// The target is not known yet, or stands in two of the words that the processor fetches.
void Engine::enter_split(Reach reach, Refill refill) {
  if (at_->run == kNotDecoded.run) decode_here();
  if (at_->entry >= Entry::kSplit && refill < kLoaded) spend(1);
  fetch_target(reach);
  if (at_->entry == Entry::kSplitLine) next_line();
}

/// A branch's own line is there, the next one is under way, any other has to be asked for.
void Engine::fetch_target(Reach reach) {
  if (reach == kSameLine) return;
  if (reach == kNextLine) return next_line();
  now_ += line_wait_;
  line_ready_ = now_ + line_wait_ + cycle_;
}

/// The next line is needed. With prefetch its fetch began when this one was there.
void Engine::next_line() {
  if (prefetches_)
    now_ = std::max(now_, line_ready_);
  else
    now_ += line_wait_;
  line_ready_ = now_ + line_wait_ + cycle_;
}

/// Data go first (p: what the prefetch has begun comes later by that).
void Engine::read_flash() {
  now_ += flash_wait_;
  line_ready_ += flash_wait_ + cycle_;
}

void Engine::set_flash(unsigned wait_states, bool prefetches) {
  flash_wait_ = std::uint64_t{wait_states} * cycle_;
  line_wait_ = page_->in_flash ? flash_wait_ : 0;
  prefetches_ = prefetches;
  line_bits_ = prefetches ? kLineBits : kWordBits;
  forget_code();
}

void Engine::exchange(std::uint32_t target, Refill refill) {
  constexpr std::uint32_t kReturns = 0xF0000000;
  if (ipsr_ != 0 && target >= kReturns) return return_by(target);
  set_thumb(target);
  go(target & ~1U, refill);
}

void Engine::return_by(std::uint32_t exc_return) {
  returned_at_ = pc();
  leave_memory(exc_return & ~1U);
  trap(Trap::kExceptionReturn);
}

/// A halfword outside of all memories counts as 0: the value that a bus would give is unknown.
Instruction Engine::decode_at(std::uint32_t address) {
  std::uint16_t halfwords[2] = {};
  for (std::uint32_t i = 0; i < 2; ++i)
    if (const Memory* memory = memory_at(address + 2 * i))
      std::memcpy(&halfwords[i], memory->bytes + (address + 2 * i - memory->start), 2);
  return decode(address, halfwords[0], halfwords[1]);
}

void Engine::decode_here() {
  const std::uint32_t here = pc();
  Instruction made = decode_at(here);
  const std::uint32_t behind = here + 2U * made.halfwords;
  const Instruction next = decode_at(behind);
  const bool splits = made.halfwords == 2 && here % 4 != 0;
  made.entry = !splits ? Entry::kPlain : reach(here, here + 2) == kSameLine ? Entry::kSplit : Entry::kSplitLine;
  made.cost = static_cast<std::uint16_t>(cost_ != 0 ? cost_ : kCycle * cycles_before(made, next));
  const std::uint32_t last = behind + 2U * (next.halfwords - 1U);  // halfword that has to be there
  made.ends_line = reach(behind - 2, last) != kSameLine;
  if (made.kind == Kind::kBranch) aim(made, here);
  page_->instructions[(here - page_->start) / 2] = made;
}

void Engine::aim(Instruction& branch, std::uint32_t here) const {
  const std::uint32_t target = branch.value;
  branch.shift = kFar;
  if (target - page_->start >= page_->bytes) return;
  branch.shift = reach(here + 2 * (branch.halfwords - 1U), target);
  branch.value = static_cast<std::uint32_t>(static_cast<std::int32_t>(target - here) / 2);
}

// --- memory

// NOLINTNEXTLINE(readability-non-const-parameter): stores go there
void Engine::map(std::uint32_t address, std::uint32_t size, std::uint8_t* memory, bool writable) {
  memories_.push_back({address, size, memory, writable, {}});
  memories_.back().pages.resize((size + kPageBytes - 1) / kPageBytes);
  code_ = nullptr;
  set_direct();
}

/// The last three bytes of a memory are left to load_elsewhere() and store_elsewhere().
void Engine::set_direct() {
  loads_ = stores_ = constants_ = {};
  if (reports_data_) return;
  for (const Memory& memory : memories_) {
    const Direct direct = {memory.start, memory.size - 3, memory.bytes};
    if (!memory.writable && constants_.limit == 0) constants_ = direct;
    if (memory.writable) loads_ = direct;
    if (memory.writable && !ram_has_code_ && !looks_at_stores_) stores_ = direct;
  }
}

void Engine::look_at_stores(bool on) {
  has_stored_ = false;
  if (std::exchange(looks_at_stores_, on) != on) set_direct();
}

void Engine::report_data(bool on) {
  reports_data_ = on;
  set_direct();
}

void Engine::forget_code() {
  for (Memory& memory : memories_)
    for (const CodePage& page : memory.pages)
      if (page.instructions) std::for_each_n(page.instructions.get(), page.bytes / 2, forget);
}

/// The instructions that have one of these bytes.
void Engine::forget_code(const Memory& memory, std::uint32_t address, unsigned bytes) {
  const std::uint32_t first = (address - memory.start) / 2, end = (address - memory.start + bytes + 1) / 2;
  for (std::uint32_t halfword = first == 0 ? 0 : first - 1; halfword < end; ++halfword) {
    const CodePage& page = memory.pages[halfword / (kPageBytes / 2)];
    if (page.instructions) forget(page.instructions[halfword % (kPageBytes / 2)]);
  }
}

Engine::Memory* Engine::memory_at(std::uint32_t address) {
  const auto found = std::find_if(memories_.begin(), memories_.end(),
                                  [&](const Memory& each) { return address - each.start < each.size; });
  return found == memories_.end() ? nullptr : &*found;
}

bool Engine::is_window(std::uint32_t address) const {
  return std::any_of(
      windows_.begin(), windows_.end(), [&](const Window& window) { return address - window.start < window.size; });
}

bool Engine::fail(std::uint32_t address) {
  bad_address_ = address;
  refuse(Trap::kBadAccess);
  return false;
}

namespace {

/// How much of an access goes to the bus at once: what is not aligned is cut up (Cortex-M3 technical reference manual,
/// bus mapping of unaligned accesses).
unsigned part_of(std::uint32_t address, unsigned bytes) {
  if (address % 2 != 0 || bytes == 1) return 1;
  return address % 4 != 0 || bytes < 4 ? 2 : 4;
}

}  // namespace

bool Engine::load_elsewhere(std::uint32_t address, unsigned bytes, std::uint32_t& value) {
  if (reports_data_) events_.on_data(address, bytes, false);
  value = 0;
  if (part_of(address, bytes) == bytes) return load_part(address, bytes, value) || fail(address);
  for (unsigned done = 0; done < bytes;) {
    const std::uint32_t at = address + done;
    const unsigned part = part_of(at, bytes - done);
    std::uint32_t piece = 0;
    if (!load_part(at, part, piece)) return fail(at);
    value |= piece << 8 * (done & 3U);
    done += part;
  }
  return true;
}

bool Engine::store_elsewhere(std::uint32_t address, unsigned bytes, std::uint32_t value) {
  if (reports_data_) events_.on_data(address, bytes, true);
  for (unsigned done = 0; done < bytes;) {
    const std::uint32_t at = address + done;
    const unsigned part = part_of(at, bytes - done);
    const std::uint32_t mask = part == 4 ? ~0U : (1U << 8 * part) - 1;
    if (!store_part(at, part, value >> 8 * (done & 3U) & mask)) return fail(at);
    done += part;
  }
  return true;
}

bool Engine::load_part(std::uint32_t address, unsigned bytes, std::uint32_t& value) {
  if (is_window(address)) {
    access_failed_ = false;
    value = events_.on_load(address, bytes);
    accessed_ = now_;
    return !access_failed_;
  }
  const Memory* const memory = memory_at(address);
  if (memory == nullptr) return false;
  if (!memory->writable) read_flash();
  std::memcpy(&value, memory->bytes + (address - memory->start), bytes);
  return true;
}

bool Engine::store_part(std::uint32_t address, unsigned bytes, std::uint32_t value) {
  if (Memory* memory = memory_at(address)) {
    if (!memory->writable) return false;
    has_stored_ = true;
    std::memcpy(memory->bytes + (address - memory->start), &value, bytes);
    forget_code(*memory, address, bytes);
    if (address - watched_.start < watched_.size) events_.on_watched_store();
    return true;
  }
  if (!is_window(address)) return false;
  access_failed_ = false;
  events_.on_store(address, bytes, value);
  accessed_ = now_;
  return !access_failed_;
}

// --- registers

std::uint32_t Engine::xpsr() const {
  return (negative_ & kNegative) | (zero_ == 0 ? kZero : 0) | (carry_ != 0 ? kCarry : 0) |
         (overflow_ != 0 ? kOverflow : 0) | (saturated_ ? kSaturated : 0) | (thumb_ ? kThumb : 0) |
         (it_ & 3U) << kItLow | static_cast<std::uint32_t>(it_ >> 2U) << kItHigh | ipsr_;
}

void Engine::set_flags(std::uint32_t apsr) {
  negative_ = apsr & kNegative;
  zero_ = (apsr & kZero) != 0 ? 0 : 1;
  carry_ = (apsr & kCarry) != 0 ? 1 : 0;
  overflow_ = (apsr & kOverflow) != 0 ? 1 : 0;
  saturated_ = (apsr & kSaturated) != 0;
}

void Engine::set_xpsr(std::uint32_t value) {
  set_flags(value);
  thumb_ = (value & kThumb) != 0;
  it_ = static_cast<std::uint8_t>((value >> kItLow & 3U) | (value >> kItHigh & 0x3FU) << 2U);
  ipsr_ = value & kException;
}

void Engine::set_mode(std::uint32_t xpsr, std::uint32_t control, std::uint32_t msp, std::uint32_t psp) {
  set_xpsr(xpsr);
  control_ = control;
  msp_ = msp & ~3U;
  psp_ = psp & ~3U;
  bank_in();
}

std::uint32_t Engine::read(Register which) const {
  switch (which) {
    case Register::kPc: return pc();
    case Register::kXpsr: return xpsr();
    case Register::kMsp: return uses_psp() ? msp_ : r_[13];
    case Register::kPsp: return uses_psp() ? r_[13] : psp_;
    case Register::kPrimask: return primask_;
    case Register::kBasepri: return basepri_;
    case Register::kFaultmask: return faultmask_;
    case Register::kControl: return control_;
    default: return r_.at(static_cast<std::size_t>(which));
  }
}

void Engine::write(Register which, std::uint32_t value) {
  switch (which) {
    case Register::kSp: r_[13] = value & ~3U; break;
    case Register::kPc:
      turn_page(value & ~1U);
      line_ready_ = now_ + line_wait_ + cycle_;
      break;
    case Register::kXpsr:
      bank_out();
      set_xpsr(value);
      bank_in();
      break;
    case Register::kMsp: (uses_psp() ? msp_ : r_[13]) = value & ~3U; break;
    case Register::kPsp: (uses_psp() ? r_[13] : psp_) = value & ~3U; break;
    case Register::kPrimask: primask_ = value & 1U; break;
    case Register::kBasepri: basepri_ = value & 0xFFU; break;
    case Register::kFaultmask: faultmask_ = value & 1U; break;
    case Register::kControl:
      bank_out();
      control_ = ipsr_ == 0 ? value & (kNotPrivileged | kSpSel) : (control_ & kSpSel) | (value & kNotPrivileged);
      bank_in();
      break;
    default: r_.at(static_cast<std::size_t>(which)) = value; break;
  }
}

bool EngineState::operator==(const EngineState& other) const {
  const auto all = [](const EngineState& s) {
    return std::tie(s.pc, s.xpsr, s.msp, s.psp, s.primask, s.basepri, s.faultmask, s.control, s.r, s.exclusive,
                    s.line_ready);
  };
  return all(*this) == all(other);
}

EngineState Engine::state() const {
  EngineState state = {pc(), xpsr(), msp_, psp_, primask_, basepri_, faultmask_, control_, {}, exclusive_, 0};
  std::copy_n(r_.begin(), state.r.size(), state.r.begin());
  state.line_ready = line_ready_ > now_ ? line_ready_ - now_ : 0;
  return state;
}

std::uint64_t Engine::gives_way_at() const {
  return breakable_until_ == executed_ && cycle_ != 0 ? std::max(breakable_since_, accessed_) : executed_;
}

/// The next instruction is fetched beside the return, unless the one broken off jumps itself. To resume takes a cycle
/// more (p: the technical reference manual says 1 or 2, 3.3.2).
Engine::Rest Engine::rest(std::uint64_t time) const {
  if (time >= executed_) return {};
  const std::uint64_t again = restarts_ ? executed_ - breakable_since_ : executed_ - time + kCycle;
  return {again + (jumps_ ? now_ - executed_ : 0), restarts_};
}

void Engine::resume(const Rest& rest) {
  const std::uint64_t since = now_;
  set_now(now_ + rest.time);
  if (rest.time != 0) breakable(since, rest.restarts);
}

void Engine::repeat(std::uint64_t times, std::uint64_t time, std::uint64_t instructions) {
  set_now(now_ + times * time);
  line_ready_ += times * time;
  instructions_ += times * instructions;
}

// Numbers of SYSm (B5.2.2).
enum Special : unsigned {
  kMspNumber = 8,
  kPspNumber,
  kPrimaskNumber = 16,
  kBasepriNumber,
  kBasepriMaxNumber,
  kFaultmaskNumber,
  kControlNumber
};

std::uint32_t Engine::read_special(unsigned which) const {
  if (which < kMspNumber) {
    const std::uint32_t all = xpsr();
    return ((which & 1U) != 0 ? all & kException : 0) | ((which & 4U) == 0 ? all & kFlags : 0);
  }
  if (which == kControlNumber) return control_;
  if (!privileged()) return 0;
  switch (which) {
    case kMspNumber: return read(Register::kMsp);
    case kPspNumber: return read(Register::kPsp);
    case kPrimaskNumber: return primask_;
    case kBasepriNumber:
    case kBasepriMaxNumber: return basepri_;
    case kFaultmaskNumber: return faultmask_;
    default: return 0;
  }
}

void Engine::write_special(unsigned which, bool flags, std::uint32_t value) {
  if (which < 4 && flags) set_flags(value);
  if (!privileged()) return;
  switch (which) {
    case kMspNumber: write(Register::kMsp, value); break;
    case kPspNumber: write(Register::kPsp, value); break;
    case kPrimaskNumber: write(Register::kPrimask, value); break;
    case kBasepriNumber: write(Register::kBasepri, value); break;
    case kBasepriMaxNumber:
      if ((value & 0xFFU) != 0 && (basepri_ == 0 || (value & 0xFFU) < basepri_)) write(Register::kBasepri, value);
      break;
    case kFaultmaskNumber: write(Register::kFaultmask, value); break;
    case kControlNumber: write(Register::kControl, value); break;
    default: break;
  }
}

}  // namespace dsdpv1::arm
