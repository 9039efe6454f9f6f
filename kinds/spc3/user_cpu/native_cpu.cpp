#include "kinds/spc3/user_cpu/native_cpu.hpp"

#include <algorithm>
#include <utility>

namespace dsdpv1::spc3_user {

NativeCpu::NativeCpu(RegisterCall& chip, const CpuTiming& timing, std::function<void()> program, Tick start)
    : chip_(chip), timing_(timing), ready_at_(start), fiber_(std::move(program)) {}

// --- the bench's side ------------------------------------------------------------------------------------------------

Tick NativeCpu::next() const {
  if (fiber_.ended()) return bus::kNever;
  Tick at = ready_at_;
  if (op_ >= Op::kWait && handler_ && !in_handler_) at = std::min(at, interrupt_at_);
  if (op_ == Op::kWaitForWake) at = std::min(at, wake_at_);
  return std::max(now_, at);
}

void NativeCpu::run(Tick now) {
  Tick at = now;
  do {
    now_ = std::max(now_, at);
    act();
    at = next();
  } while (at <= now_ || (others != nullptr && others->go_on(at)));
}

/// An access takes effect at its end, then the program continues.
void NativeCpu::act() {
  if (op_ == Op::kRead) value_ = chip_.load(now_, address_);
  if (op_ == Op::kWrite) chip_.store(now_, address_, value_);
  op_ = Op::kWait;
  ready_at_ = bus::kNever;
  fiber_.resume();
}

// --- the program's side ----------------------------------------------------------------------------------------------

void NativeCpu::suspend_until(Tick at, Op op) {
  op_ = op;
  ready_at_ = at;
  fiber_.suspend();
}

void NativeCpu::access(Op op, std::uint16_t address, std::uint8_t value) {
  address_ = address;
  value_ = value;
  ++counters_.accesses;
  suspend_until(now_ + timing_.access, op);
}

std::uint8_t NativeCpu::read(std::uint16_t address) {
  access(Op::kRead, address, 0);
  const std::uint8_t value = value_;  // before a handler reads another
  serve_interrupt();
  return value;
}

void NativeCpu::write(std::uint16_t address, std::uint8_t value) {
  access(Op::kWrite, address, value);
  serve_interrupt();
}

void NativeCpu::wait_until(Tick at) {
  while (now_ < at && !fiber_.unwinding()) {
    suspend_until(at, Op::kWait);
    serve_interrupt();
  }
}

bool NativeCpu::wait_for_wake(Tick until) {
  while (now_ < until && wake_at_ > now_ && !fiber_.unwinding()) {
    suspend_until(until, Op::kWaitForWake);
    serve_interrupt();
  }
  const bool woken = wake_at_ <= now_;
  if (woken) wake_at_ = bus::kNever;
  return woken;
}

void NativeCpu::serve_interrupt() {
  while (interrupt_is_due()) {
    interrupt_at_ = bus::kNever;
    in_handler_ = true;
    ++counters_.interrupts;
    handler_();
    in_handler_ = false;
  }
}

}  // namespace dsdpv1::spc3_user
