// Exception entry and return, and faults (ARMv7-M, B1.5).
#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "board/cpu/cortex_m3.hpp"

namespace dsdpv1::arm {

namespace {

constexpr std::uint32_t kThumb = 1U << 24, kExceptionBits = 0x1FF, kAlignedBit = 1U << 9, kItBits = 0x0600FC00,
                        kFlags = 0xF8000000;
constexpr std::uint32_t kSpSel = 2, kNotPrivileged = 1;
constexpr std::uint32_t kToHandler = 0xFFFFFFF1, kToThread = 0xFFFFFFF9, kToThreadPsp = 0xFFFFFFFD;
constexpr std::uint32_t kReturnThreadBit = 8, kReturnPspBit = 4;
constexpr std::uint32_t kFrameBytes = 32;

// The registers of a frame from its lowest address on; ReturnAddress and XPSR follow.
constexpr Register kStacked[] = {
    Register::kR0, static_cast<Register>(1), static_cast<Register>(2), static_cast<Register>(3), Register::kR12,
    Register::kLr};

// Regions that instructions may be fetched from when something is there (B3.1): code, SRAM, external RAM.
bool executable_region(std::uint32_t address) {
  return address < 0x40000000 || (address >= 0x60000000 && address < 0xA0000000);
}

}  // namespace

Nvic::Masks CortexM3::masks() const {
  return {(engine_.read(Register::kPrimask) & 1U) != 0, (engine_.read(Register::kFaultmask) & 1U) != 0,
          static_cast<std::uint8_t>(engine_.read(Register::kBasepri))};
}

unsigned CortexM3::preempting() const {
  return nvic_.foremost() == kNoException ? kNoException : nvic_.preempting(nvic_.execution_priority(masks()));
}

unsigned CortexM3::handler() const { return engine_.read(Register::kXpsr) & kExceptionBits; }

// Returns EXC_RETURN for the way back (B1.5.6, B1.5.7).
std::uint32_t CortexM3::push_frame(std::uint32_t return_address) {
  const std::uint32_t xpsr = engine_.read(Register::kXpsr);
  const std::uint32_t control = engine_.read(Register::kControl);
  const bool thread = (xpsr & kExceptionBits) == 0;
  const bool on_psp = thread && (control & kSpSel) != 0;
  std::uint32_t msp = engine_.read(Register::kMsp), psp = engine_.read(Register::kPsp);
  std::uint32_t& sp = on_psp ? psp : msp;
  const bool aligned = scb_.stack_align() && (sp & 4U) != 0;
  sp -= kFrameBytes + (aligned ? 4 : 0);
  write_frame(sp, return_address, (xpsr & ~kAlignedBit) | (aligned ? kAlignedBit : 0));
  engine_.set_mode((xpsr & ~kItBits) | kThumb, control, msp, psp);
  return !thread ? kToHandler : on_psp ? kToThreadPsp : kToThread;
}

void CortexM3::write_frame(std::uint32_t sp, std::uint32_t return_address, std::uint32_t xpsr) {
  if (!in_ram(sp, kFrameBytes)) {
    pend_fault(FaultKind::kStacking, pc(), sp);  // the frame is lost, the exception continues (B1.5.11)
    return;
  }
  std::array<std::uint32_t, kFrameBytes / 4> frame{};
  std::size_t count = 0;
  for (const Register which : kStacked) frame[count++] = engine_.read(which);
  frame[count++] = return_address;
  frame[count] = xpsr;
  std::memcpy(ram_ + (sp - map_.ram_base), frame.data(), kFrameBytes);
}

void CortexM3::take_exception(std::uint32_t return_address, const Engine::Rest& rest) {
  broken_off_.at(nvic_.active_count()) = rest;
  enter(timing_.exception_entry, push_frame(return_address));
}

/// Vector and first instruction, beside nothing else.
std::uint32_t CortexM3::chain_cycles() const { return timing_.tail_chain + 2 * engine_.wait_states(); }

/// One that arrives late and goes first has its own vector fetched (B1.5.4; p: which takes as long as to chain).
void CortexM3::enter(std::uint32_t cycles, std::uint32_t exc_return) {
  unsigned first = preempting();
  for (std::uint64_t end = engine_.now() + cycles * kMillis; engine_.now() < end;) {
    step_towards(end);
    if (std::exchange(first, preempting()) != first) end = std::max(end, engine_.now() + chain_cycles() * kMillis);
  }
  activate(first, exc_return);
}

// The handler begins; what it interrupted is on the stack.
void CortexM3::activate(unsigned exception, std::uint32_t exc_return) {
  nvic_.begin(exception);
  polling_.end();
  event_ = true;
  engine_.clear_exclusive();
  const std::uint32_t flags = engine_.read(Register::kXpsr) & kFlags;
  engine_.set_mode(flags | kThumb | exception, engine_.read(Register::kControl) & kNotPrivileged,
                   engine_.read(Register::kMsp), engine_.read(Register::kPsp));
  engine_.write(Register::kLr, exc_return);
  continue_at(word_at(scb_.vector_table() + 4 * exception));
}

void CortexM3::continue_at(std::uint32_t target) {
  engine_.write(Register::kPc, target);
  if ((target & 1U) == 0) raise(FaultKind::kInvalidState, 0);
}

// B1.5.8: only these values, and thread mode only from the outermost handler unless CCR.NONBASETHRDENA.
bool CortexM3::return_allowed(std::uint32_t exc_return) const {
  if (handler() >= Nvic::kExceptions || !nvic_.active(handler())) return false;
  const bool outermost = nvic_.active_count() == 1;
  switch (exc_return) {
    case kToHandler: return !outermost;
    case kToThread:
    case kToThreadPsp: return outermost || scb_.return_to_thread_from_nested();
    default: return false;
  }
}

void CortexM3::end_handler(unsigned exception) {
  nvic_.end(exception);
  if (nvic_.unserved(exception) == System::kStorm) system_.storm(exception - kFirstInterrupt, engine_.returned_at());
}

void CortexM3::return_from_exception() {
  const std::uint32_t exc_return = engine_.read(Register::kPc) | 1U;
  const bool allowed = return_allowed(exc_return);
  const unsigned ended = handler();
  if (ended < Nvic::kExceptions)  // a debugger may have written any number into XPSR
    end_handler(ended);
  if (ended != kNmi) engine_.write(Register::kFaultmask, 0);
  event_ = true;
  if (!allowed) {
    chain_fault(FaultKind::kExceptionReturn, exc_return, exc_return);
    return;
  }
  if ((exc_return & kReturnThreadBit) != 0 && scb_.sleep_on_exit()) doze(false);
  preempting() != kNoException ? enter(chain_cycles(), exc_return) : unstack(exc_return);
}

// A fault of the return itself: its handler begins without new stacking, the old frame stays.
void CortexM3::chain_fault(FaultKind kind, std::uint32_t address, std::uint32_t exc_return) {
  pend_fault(kind, engine_.returned_at(), address);
  enter(timing_.tail_chain, exc_return);
}

/// Given up for an exception that arrives meanwhile: the frame stays.
void CortexM3::unstack(std::uint32_t exc_return) {
  const bool to_thread = (exc_return & kReturnThreadBit) != 0, on_psp = (exc_return & kReturnPspBit) != 0;
  std::uint32_t msp = engine_.read(Register::kMsp), psp = engine_.read(Register::kPsp);
  std::uint32_t& sp = on_psp ? psp : msp;
  if (!in_ram(sp, kFrameBytes)) {
    chain_fault(FaultKind::kUnstacking, sp, exc_return);
    return;
  }
  const std::uint32_t frame = sp, xpsr = word_at(frame + 28);
  if (((xpsr & kExceptionBits) == 0) != to_thread || (xpsr & kExceptionBits) >= Nvic::kExceptions) {
    chain_fault(FaultKind::kExceptionReturn, xpsr, exc_return);
    return;
  }
  for (const std::uint64_t end = engine_.now() + timing_.exception_return * kMillis; engine_.now() < end;) {
    step_towards(end);
    if (preempting() != kNoException) return enter(chain_cycles(), exc_return);
  }
  sp += kFrameBytes + (scb_.stack_align() && (xpsr & kAlignedBit) != 0 ? 4 : 0);
  const std::uint32_t control =
      (engine_.read(Register::kControl) & kNotPrivileged) | (to_thread && on_psp ? kSpSel : 0);
  engine_.set_mode(xpsr & ~kAlignedBit, control, msp, psp);
  for (std::uint32_t word = 0; word < 6; ++word) engine_.write(kStacked[word], word_at(frame + 4 * word));
  const std::uint32_t target = word_at(frame + 24) & ~1U;
  engine_.clear_exclusive();
  engine_.resume(std::exchange(broken_off_.at(nvic_.active_count()), {}));
  continue_at(target | ((xpsr & kThumb) != 0 ? 1U : 0U));
}

void CortexM3::supervisor_call() {
  constexpr std::uint32_t kSvcBytes = 2;
  const std::uint32_t next = engine_.read(Register::kPc);
  if (nvic_.group_priority(kSvCall) < nvic_.execution_priority(masks()))
    nvic_.set_pending(kSvCall);
  else
    pend_fault(FaultKind::kSupervisorCall, next - kSvcBytes, 0);
  take_exception(next);
}

// The instruction at PC has caused it.
void CortexM3::raise(FaultKind kind, std::uint32_t address) {
  pend_fault(kind, pc(), address);
  take_exception(pc());
}

// Sets the status bits and returns the exception that is the fault's own (B1.5.14).
unsigned CortexM3::record(FaultKind kind, std::uint32_t address) {
  switch (kind) {
    case FaultKind::kUndefinedInstruction: scb_.record_fault(kUfUndefInstr); return kUsageFault;
    case FaultKind::kNoCoprocessor: scb_.record_fault(kUfNoCp); return kUsageFault;
    case FaultKind::kInvalidState: scb_.record_fault(kUfInvState); return kUsageFault;
    case FaultKind::kExceptionReturn: scb_.record_fault(kUfInvPc); return kUsageFault;
    case FaultKind::kUnaligned: scb_.record_fault(kUfUnaligned); return kUsageFault;
    case FaultKind::kData: scb_.record_bus_fault(kBfPrecisErr, address); return kBusFault;
    case FaultKind::kStacking: scb_.record_fault(kBfStkErr); return kBusFault;
    case FaultKind::kUnstacking: scb_.record_fault(kBfUnstkErr); return kBusFault;
    case FaultKind::kFetch:
      if (executable_region(address)) {
        scb_.record_fault(kBfIbusErr);
        return kBusFault;
      }
      scb_.record_fault(kIaccViol);
      return kMemManage;
    case FaultKind::kBreakpoint:
    case FaultKind::kSupervisorCall: break;
  }
  return kHardFault;
}

FaultOutcome CortexM3::outcome(unsigned fault_handler, int priority) const {
  if (priority <= -1) return FaultOutcome::kLockup;
  const std::uint32_t vector = word_at(scb_.vector_table() + 4 * fault_handler);
  return (vector & 1U) != 0 && executable(vector) ? FaultOutcome::kHandled : FaultOutcome::kNoHandler;
}

// The fault's handler becomes pending, or the run ends.
void CortexM3::pend_fault(FaultKind kind, std::uint32_t pc, std::uint32_t address) {
  Fault fault{kind, pc, address, registers(), kHardFault, FaultOutcome::kHandled, {}};
  fault.registers.pc = pc;
  const int priority = nvic_.execution_priority(masks());
  const unsigned own = record(kind, address);
  if (own != kHardFault && scb_.handles(own) && nvic_.group_priority(own) < priority)
    fault.handler = own;
  else
    scb_.record_hard_fault(kind == FaultKind::kBreakpoint ? kHfDebugEvt : kHfForced);
  fault.outcome = outcome(fault.handler, priority);
  fault.text = describe(fault);
  if (report_fault_) report_fault_(fault);
  if (fault.outcome != FaultOutcome::kHandled) {
    if (debugger_ != nullptr) debugger_->fault(fault.text);
    throw FaultError(std::move(fault));
  }
  nvic_.set_pending(fault.handler);
}

}  // namespace dsdpv1::arm
