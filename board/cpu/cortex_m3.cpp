#include "board/cpu/cortex_m3.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace dsdpv1::arm {

namespace {

constexpr std::size_t kHostPage = 4096;
constexpr std::uint32_t kThumb = 1U << 24;

// What the System is asked for; code and SRAM regions hold only the memories and answer nothing else (ARMv7-M, B3.1).
struct Region {
  std::uint32_t start;
  std::uint32_t size;
};
constexpr Region kOutside[] = {
    {0x1FFFF000, 0x00001000},  // system memory, option bytes and unique id of the STM32F1
    {0x22000000, 0x02000000},  // bit-band alias of RAM
    {0x40000000, 0xA0000000},  // peripherals with their bit-band alias, external RAM, external devices
    {0xE0000000, 0x00100000},  // private peripheral bus
};

// Milliseconds of real time are what a debugger's poll needs; attend() comes every quarter of a microsecond of
// simulated time.
constexpr unsigned kAttendsPerPoll = 4096;
constexpr std::uint64_t kCyclesPerPoll = 720'000;  // while asleep: 10 ms at 72 MHz

}  // namespace

CortexM3::CortexM3(System& system, const MemoryMap& map, const Timing& timing)
    : system_(system), map_(map), timing_(timing), memory_(map.flash_size + map.ram_size + kHostPage), engine_(*this) {
  map_memory();
}

CortexM3::~CortexM3() = default;

void CortexM3::map_memory() {
  void* first_page = memory_.data();
  std::size_t room = memory_.size();
  flash_ = static_cast<std::uint8_t*>(std::align(kHostPage, map_.flash_size + map_.ram_size, first_page, room));
  ram_ = flash_ + map_.flash_size;
  std::fill_n(flash_, map_.flash_size, std::uint8_t{0xFF});  // erased
  engine_.map(map_.flash_base, map_.flash_size, flash_, false);
  engine_.map(0, map_.flash_size, flash_, false);
  engine_.map(map_.ram_base, map_.ram_size, ram_, true);
  for (const Region& region : kOutside) engine_.map_events(region.start, region.size);
}

const std::uint8_t* CortexM3::host(std::uint32_t address) const {
  if (address - map_.flash_base < map_.flash_size) return flash_ + (address - map_.flash_base);
  if (address - map_.ram_base < map_.ram_size) return ram_ + (address - map_.ram_base);
  return address < map_.flash_size ? flash_ + address : nullptr;
}

std::uint16_t CortexM3::opcode_at(std::uint32_t address) const {
  std::uint16_t opcode = 0;
  if (const std::uint8_t* code = host(address)) std::memcpy(&opcode, code, sizeof opcode);
  return opcode;
}

std::uint32_t CortexM3::word_at(std::uint32_t address) const {
  return opcode_at(address) | static_cast<std::uint32_t>(opcode_at(address + 2)) << 16;
}

bool CortexM3::in_ram(std::uint32_t address, std::uint32_t count) const {
  return address - map_.ram_base < map_.ram_size && map_.ram_size - (address - map_.ram_base) >= count;
}

void CortexM3::load(std::uint32_t address, const std::uint8_t* bytes, std::size_t count) {
  if (count == 0) return;
  const std::uint8_t* first = host(address);
  const auto last = static_cast<std::uint32_t>(address + count - 1);
  if (first == nullptr || last < address || host(last) != first + (count - 1))
    throw std::out_of_range("CortexM3::load: outside of flash and RAM");
  std::memcpy(memory_.data() + (first - memory_.data()), bytes, count);
  forget_code();
}

// Translations of instructions that may have been changed go before the next one is executed.
void CortexM3::forget_code() {
  stale_code_ = translated_;
  check_at_ = 0;
}

void CortexM3::run() {
  stopped_ = false;
  reset_processor();
  while (!stopped_) advance_run();
}

void CortexM3::stop() {
  stopped_ = true;
  check_at_ = 0;
}

void CortexM3::reset_processor() {
  nvic_.reset();
  systick_.reset();
  scb_.reset();
  it_ = ItBlock();
  event_ = reset_requested_ = moved_ = announced_ = false;
  due_ = 0;
  keep_up_at_ = now_;
  for (const Register mask : {Register::kPrimask, Register::kBasepri, Register::kFaultmask}) engine_.write(mask, 0);
  enter_mode(kThumb, 0, word_at(scb_.vector_table()) & ~3U, 0);
  engine_.write(Register::kLr, 0xFFFFFFFF);  // B1.5.5
  continue_at(word_at(scb_.vector_table() + 4));
}

void CortexM3::advance_run() {
  leaving_ = Leave::kNo;
  hint_ = Sleep::kNone;
  check_at_ = 0;
  engine_.report_data(report_data_);
  if (std::exchange(stale_code_, false)) engine_.forget_translations();
  if (it_.open())  // Unicorn keeps ITSTATE of its own, not always that of the next instruction
    engine_.write(Register::kXpsr, read_register(Register::kXpsr));
  translated_ = true;
  const Trap trap = engine_.run();
  switch (leaving_) {
    case Leave::kFailure: std::rethrow_exception(std::exchange(failure_, nullptr));
    case Leave::kBetween: between_instructions(); break;
    case Leave::kBusError:
      settle_instruction();
      raise(FaultKind::kData, at_, bad_address_);
      break;
    case Leave::kNo:
      settle_instruction();
      handle_trap(trap);
      break;
  }
}

void CortexM3::handle_trap(Trap trap) {
  const std::uint32_t pc = engine_.read(Register::kPc);
  switch (trap) {
    case Trap::kNone: doze(); break;
    case Trap::kSvc: supervisor_call(); break;
    case Trap::kExceptionReturn: return_from_exception(); break;
    case Trap::kBreakpoint: raise(FaultKind::kBreakpoint, pc, 0); break;
    case Trap::kPrefetchAbort: raise(FaultKind::kFetch, pc, pc); break;
    case Trap::kNoCoprocessor: raise(FaultKind::kNoCoprocessor, pc, 0); break;
    case Trap::kInvalidState: raise(FaultKind::kInvalidState, pc, 0); break;
    case Trap::kUndefined:
      if (hint_ == Sleep::kWfe)
        doze();
      else
        raise(FaultKind::kUndefinedInstruction, pc, 0);
      break;
    case Trap::kBadAccess:
      raise(bad_fetch_ ? FaultKind::kFetch : FaultKind::kData, bad_fetch_ ? bad_address_ : at_, bad_address_);
      break;
  }
}

void CortexM3::between_instructions() {
  if (moved_) {
    moved_ = false;
    it_.end();
    engine_.write(Register::kPc, at_);
  } else if (reset_requested_) {
    system_.reset();
    reset_processor();
  } else if (!stopped_ && preempting() != kNoException) {
    take_exception(at_);
  } else {
    announced_ = true;  // new code only: the debugger has seen this instruction
  }
}

// The instruction at work has ended without another one to follow.
void CortexM3::settle_instruction() {
  now_ += due_;
  due_ = 0;
}

void CortexM3::leave(Leave why) {
  if (why == Leave::kBetween) {  // the instruction about to be executed is not: it comes again
    due_ = 0;
    --instructions_;
  }
  leaving_ = why;
  engine_.stop();
}

// Runs what may throw; the exception waits until Unicorn's frames are left. Until then the processor does nothing any
// more.
template <typename Action>
void CortexM3::guarded(Action action) noexcept {
  if (leaving_ != Leave::kNo) return;
  try {
    action();
  } catch (...) {
    failure_ = std::current_exception();
    leave(Leave::kFailure);
  }
}

void CortexM3::on_instruction(std::uint32_t address) noexcept {
  if (leaving_ != Leave::kNo) return;
  now_ += due_;
  due_ = timing_.millicycles_per_instruction;
  ++instructions_;
  at_ = address;
  const std::uint16_t opcode = opcode_at(address);
  inside_it_ = it_.open() && follow_it_block(address, opcode);
  if (now_ >= check_at_) {
    guarded([this] { attend(); });
    if (leaving_ != Leave::kNo) return;
  }
  if ((opcode & 0xF000U) == 0xB000 || (opcode & 0xFFD0U) == 0xF380) note_hint(address, opcode);
}

// True when the instruction at `address` belongs to the open block. Those before it, whose condition failed, are
// counted here.
bool CortexM3::follow_it_block(std::uint32_t address, std::uint16_t opcode) {
  while (it_.open() && it_.next() != address) {
    it_.pass(opcode_at(it_.next()));
    ++instructions_;
    now_ += timing_.millicycles_per_instruction;
  }
  if (!it_.open()) return false;
  it_.pass(opcode);
  return true;
}

// Instructions that change what the processor has to look after. Encodings: ARMv7-M, A5.2.5 and A5.3.4.
void CortexM3::note_hint(std::uint32_t address, std::uint16_t opcode) {
  const bool wide_hint = opcode == 0xF3AF;
  const std::uint16_t hint =
      wide_hint ? static_cast<std::uint16_t>(0xBF00 | (opcode_at(address + 2) & 0xFU) << 4) : opcode;
  if ((hint & 0xFF00U) == 0xBF00) {
    if ((hint & 0xFU) != 0)
      it_.begin(address + 2, static_cast<std::uint8_t>(hint), [this](std::uint32_t at) { return opcode_at(at); });
    else if (hint == 0xBF20)
      hint_ = Sleep::kWfe;
    else if (hint == 0xBF30)
      hint_ = Sleep::kWfi;
    else if (hint == 0xBF40)
      event_ = true;  // SEV
  } else if ((opcode & 0xFFE8U) == 0xB660 || (opcode & 0xFFF0U) == 0xF380) {
    check_at_ = 0;  // CPS, MSR: a pending exception may be unmasked from the next instruction on
  }
}

void CortexM3::attend() {
  catch_up();
  if (debugger_ != nullptr && !stopped_ && !std::exchange(announced_, false)) attend_debugger();
  if (!inside_it_ && (stopped_ || reset_requested_ || moved_ || stale_code_ || preempting() != kNoException))
    leave(Leave::kBetween);
  else
    schedule();
}

void CortexM3::attend_debugger() {
  if (debugger_->wanted())
    debugger_->before_instruction(at_);
  else if (++polls_ % kAttendsPerPoll == 0)
    debugger_->poll();
}

void CortexM3::catch_up_systick() {
  if (systick_.catch_up(cycles())) nvic_.set_pending(kSysTick);
}

void CortexM3::catch_up() {
  catch_up_systick();
  if (now_ >= keep_up_at_) {
    keep_up_at_ = now_ + timing_.quantum * kMillis;
    system_.keep_up();
  }
}

void CortexM3::schedule() {
  const std::uint64_t tick = systick_.next();
  check_at_ = std::min(keep_up_at_, tick == kNever ? kNever : tick * kMillis);
  if (inside_it_ || (debugger_ != nullptr && debugger_->wanted())) check_at_ = 0;
}

// Entry, return and tail-chain. The world comes up to their end: an exception that arrives meanwhile may go first
// (B1.5.4).
void CortexM3::spend(std::uint32_t cycles) {
  now_ += cycles * kMillis;
  keep_up_at_ = now_;
  catch_up();
}

void CortexM3::advance_to(std::uint64_t cycle) { now_ = std::max(now_, cycle * kMillis); }

// WFI ends with an exception that would be taken if PRIMASK were 0; WFE also with an event (B1.5.18, B1.5.19).
void CortexM3::doze() {
  const bool for_event = hint_ == Sleep::kWfe;
  const auto woken = [this, for_event] {
    Nvic::Masks masks = this->masks();
    masks.primask = false;
    return stopped_ || reset_requested_ || moved_ || (for_event && event_) ||
           nvic_.preempting(nvic_.execution_priority(masks)) != kNoException;
  };
  while (!woken()) {
    std::uint64_t until = systick_.next();
    if (debugger_ != nullptr) until = std::min(until, cycles() + kCyclesPerPoll);
    system_.sleep(until);
    catch_up();
    if (debugger_ != nullptr) {
      at_ = engine_.read(Register::kPc);
      asleep_ = true;
      debugger_->poll();
      asleep_ = false;
    }
  }
  event_ = event_ && !for_event;
}

void CortexM3::set_interrupt(unsigned irq) {
  if (irq >= Nvic::kInterrupts) throw std::out_of_range("CortexM3::set_interrupt: interrupts are 0 to 67");
  nvic_.set_pending(kFirstInterrupt + irq);
  event_ = event_ || scb_.event_on_pend();
  check_at_ = 0;
}

void CortexM3::set_interrupt_level(unsigned irq, bool high) {
  if (irq >= Nvic::kInterrupts) throw std::out_of_range("CortexM3::set_interrupt_level: interrupts are 0 to 67");
  nvic_.set_level(kFirstInterrupt + irq, high);
  event_ = event_ || (high && scb_.event_on_pend());
  check_at_ = 0;
}

void CortexM3::bus_error() {
  bad_address_ = access_;
  leave(Leave::kBusError);
}

std::uint32_t CortexM3::on_load(std::uint32_t address, unsigned bytes) noexcept {
  std::uint32_t value = 0;
  access_ = address;
  guarded([&] { value = load_outside(address, bytes); });
  return value;
}

void CortexM3::on_store(std::uint32_t address, unsigned bytes, std::uint32_t value) noexcept {
  access_ = address;
  guarded([&] { store_outside(address, bytes, value); });
}

void CortexM3::on_bad_access(std::uint32_t address, bool fetch) noexcept {
  bad_address_ = address;
  bad_fetch_ = fetch;
}

void CortexM3::on_data(std::uint32_t address, unsigned bytes, bool write) noexcept {
  guarded([&] { debugger_->data_access(address, bytes, write); });
  check_at_ = 0;
}

}  // namespace dsdpv1::arm
