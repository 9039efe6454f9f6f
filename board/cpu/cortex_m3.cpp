#include "board/cpu/cortex_m3.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace dsdpv1::arm {

namespace {

constexpr std::size_t kHostPage = 4096;
constexpr std::uint32_t kThumb = 1U << 24;

// The System answers in these ranges. Code and SRAM regions hold only the memories (ARMv7-M, B3.1).
struct Region {
  std::uint32_t start;
  std::uint32_t size;
};
constexpr Region kOutside[] = {
    {0x40000000, 0xA0000000},  // first, as the most frequent: peripherals with bit-band alias, external RAM and devices
    {0x1FFFF000, 0x00001000},  // system memory, option bytes and unique id of the STM32F1
    {0x22000000, 0x02000000},  // bit-band alias of RAM
    {0xE0000000, 0x00100000},  // private peripheral bus
};

// A debugger is asked what it wants, 1 ms at 72 MHz; 10 ms while asleep.
constexpr std::uint64_t kCyclesPerPoll = 72'000, kCyclesPerPollAsleep = 720'000;

}  // namespace

CortexM3::CortexM3(System& system, const MemoryMap& map, const Timing& timing)
    : system_(system),
      map_(map),
      timing_(timing),
      // Not set to 0 here: map_memory() says what is in it.
      memory_(new std::uint8_t[std::size_t{map.flash_size} + map.ram_size + kHostPage]),
      engine_(*this, timing.millicycles_per_instruction) {
  map_memory();
}

CortexM3::~CortexM3() = default;

void CortexM3::map_memory() {
  void* first_page = memory_.get();
  std::size_t room = std::size_t{map_.flash_size} + map_.ram_size + kHostPage;
  flash_ = static_cast<std::uint8_t*>(std::align(kHostPage, map_.flash_size + map_.ram_size, first_page, room));
  ram_ = flash_ + map_.flash_size;
  std::fill_n(flash_, map_.flash_size, std::uint8_t{0xFF});  // erased
  std::fill_n(ram_, map_.ram_size, std::uint8_t{0});
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
  std::memcpy(memory_.get() + (first - memory_.get()), bytes, count);
  engine_.forget_code();
}

void CortexM3::run() {
  stopped_ = false;
  reset_processor();
  while (!stopped_) advance_run();
}

void CortexM3::stop() {
  stopped_ = true;
  attend_soon();
}

void CortexM3::reset_processor() {
  nvic_.reset();
  systick_.reset();
  scb_.reset();
  event_ = reset_requested_ = moved_ = false;
  broken_off_ = {};
  rest_ = {};
  for (const Register mask : {Register::kPrimask, Register::kBasepri, Register::kFaultmask}) engine_.write(mask, 0);
  engine_.set_mode(kThumb, 0, word_at(scb_.vector_table()) & ~3U, 0);
  engine_.write(Register::kLr, 0xFFFFFFFF);  // B1.5.5
  continue_at(word_at(scb_.vector_table() + 4));
}

void CortexM3::advance_run() {
  attend_soon();
  const Trap trap = engine_.run();
  if (trap == Trap::kNone)
    between_instructions();
  else
    handle_trap(trap);
}

void CortexM3::handle_trap(Trap trap) {
  switch (trap) {
    case Trap::kNone: break;
    case Trap::kSvc: supervisor_call(); break;
    case Trap::kWfi: doze(false); break;
    case Trap::kWfe: doze(true); break;
    case Trap::kExceptionReturn: return_from_exception(); break;
    case Trap::kInvalidState: raise(FaultKind::kInvalidState, 0); break;
    case Trap::kBreakpoint: raise(FaultKind::kBreakpoint, 0); break;
    case Trap::kNoCoprocessor: raise(FaultKind::kNoCoprocessor, 0); break;
    case Trap::kUndefined: raise(FaultKind::kUndefinedInstruction, 0); break;
    case Trap::kBadFetch: raise(FaultKind::kFetch, pc()); break;
    case Trap::kBadAccess: raise(FaultKind::kData, engine_.bad_address()); break;
    case Trap::kUnaligned: raise(FaultKind::kUnaligned, 0); break;
  }
}

void CortexM3::between_instructions() {
  const Engine::Rest rest = std::exchange(rest_, {});
  if (reset_requested_) {
    system_.reset();
    reset_processor();
  } else if (!std::exchange(moved_, false) && !stopped_) {
    take_exception(pc(), rest);
  }
}

bool CortexM3::before_instruction() {
  const bool looked = std::exchange(stays_, false) && !is_due();
  if (!gives_way()) looked ? catch_up_systick() : catch_up();
  if (debugger_ != nullptr && !stopped_) attend_debugger();
  if (stopped_ || reset_requested_ || moved_ || preempting() != kNoException) return false;
  schedule();
  if (timing_.leaves_out_polls && debugger_ == nullptr) looked ? leave_out_passes() : polling_.pass_by();
  return true;
}

void CortexM3::leave_out_passes() {
  const std::uint64_t since = polling_.began(), now = engine_.now();
  polling_.looked(engine_.attend_at());
  if (engine_.now() != now) system_.left_out(since / kMillis, (engine_.now() - now) / kMillis);
}

/// The world comes up to the last instruction step by step while that lets an exception in, which the instruction
/// itself may have caused. True: there is one, which begins now.
bool CortexM3::gives_way() {
  const std::uint64_t end = engine_.now();
  bool meets = std::exchange(has_met_, false);
  for (std::uint64_t at = engine_.gives_way_at(); at < end; at = std::max(at + kMillis, due())) {
    if (std::exchange(meets, false) || at >= due()) {
      engine_.turn_to(at);
      catch_up();
      engine_.turn_to(end);
    }
    if (preempting() == kNoException) continue;
    rest_ = engine_.rest(at);
    engine_.set_now(at);
    return true;
  }
  return false;
}

void CortexM3::attend_debugger() {
  if (debugger_->wanted()) return debugger_->before_instruction(pc());
  if (engine_.now() < poll_at_) return;
  poll_at_ = engine_.now() + kCyclesPerPoll * kMillis;
  debugger_->poll();
}

void CortexM3::catch_up_systick() {
  if (systick_.catch_up(cycles())) nvic_.set_pending(kSysTick);
}

void CortexM3::catch_up() {
  catch_up_systick();
  if (is_due()) polling_.restart();
  keep_up_at_ = millis(system_.keep_up());
}

void CortexM3::stays(std::uint64_t until) {
  if (is_due()) polling_.restart();
  keep_up_at_ = millis(until);
  stays_ = true;
  has_met_ = false;
}

void CortexM3::schedule() {
  const bool at_once = debugger_ != nullptr && debugger_->wanted();
  engine_.attend_at(at_once ? 0 : debugger_ != nullptr ? std::min(due(), poll_at_) : due());
}

/// Entry, return and tail-chain: a step towards `end`, and the world comes up to it.
void CortexM3::step_towards(std::uint64_t end) {
  engine_.set_now(std::min(end, std::max(due(), engine_.now() + kMillis)));
  catch_up();
}

void CortexM3::advance_to(std::uint64_t cycle) { engine_.set_now(std::max(engine_.now(), cycle * kMillis)); }

// WFI ends with an exception that would be taken if PRIMASK were 0; WFE also with an event (B1.5.18, B1.5.19).
void CortexM3::doze(bool for_event) {
  const auto woken = [this, for_event] {
    Nvic::Masks masks = this->masks();
    masks.primask = false;
    return stopped_ || reset_requested_ || moved_ || (for_event && event_) ||
           nvic_.preempting(nvic_.execution_priority(masks)) != kNoException;
  };
  while (!woken()) {
    std::uint64_t until = systick_.next();
    if (debugger_ != nullptr) until = std::min(until, cycles() + kCyclesPerPollAsleep);
    system_.sleep(until);
    catch_up();
    if (debugger_ != nullptr) {
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
  attend_soon();
}

void CortexM3::set_interrupt_level(unsigned irq, bool high) {
  if (irq >= Nvic::kInterrupts) throw std::out_of_range("CortexM3::set_interrupt_level: interrupts are 0 to 67");
  nvic_.set_level(kFirstInterrupt + irq, high);
  event_ = event_ || (high && scb_.event_on_pend());
  attend_soon();
}

void CortexM3::bus_error() { engine_.bus_error(); }

void CortexM3::attend_to_world() {
  has_met_ = true;
  attend_soon();
}

std::uint32_t CortexM3::on_load(std::uint32_t address, unsigned bytes) {
  attend_to_world();
  stays_ = false;
  const std::uint32_t value = load_outside(address, bytes);
  if (!stays_) polling_.end();
  return value;
}

void CortexM3::on_store(std::uint32_t address, unsigned bytes, std::uint32_t value) {
  attend_to_world();
  polling_.end();
  store_outside(address, bytes, value);
}

void CortexM3::on_data(std::uint32_t address, unsigned bytes, bool write) {
  debugger_->data_access(address, bytes, write);
  attend_soon();
}

}  // namespace dsdpv1::arm
