#include "kinds/user_cpu/native_cpu.hpp"

#include <algorithm>
#include <utility>

namespace dsdpv1::user_cpu {

NativeCpu::NativeCpu(HostBus& bus, const CpuTiming& timing, Program program, Tick start)
    : bus_(bus), timing_(timing), ready_at_(start), fiber_([this, program = std::move(program)] { program(*this); }) {}

// ------------------------------------------------------------------------------------------------- the bench's side

inline Tick NativeCpu::break_tick() const {
  const Tick interrupt = interrupts_open() ? interrupt_at_ : bus::kNever;
  switch (break_) {
    case Break::kWake: return std::min(interrupt, wake_at_);
    case Break::kIntr0: return std::min(interrupt, intr0_at_);
    case Break::kInterrupt: break;
  }
  return interrupt;
}

Tick NativeCpu::next() const {
  if (fiber_.ended()) return bus::kNever;
  if (request_.op == Op::kAccess) return put_off_ ? ready_at_ : std::min(bus_.next_edge(), ready_at_);
  if (request_.op == Op::kTransfer && !request_.transfer->done()) return std::max(now_, request_.transfer->next());
  return request_.op == Op::kWait ? std::max(now_, std::min(ready_at_, break_tick())) : ready_at_;
}

void NativeCpu::run(Tick now) {
  Tick at = now;
  refused_ = bus::kNever;
  do {
    now_ = at;
    if (request_.op == Op::kAccess && !put_off_ && bus_.next_edge() <= now_) run_edges(now_);
    if (request_.op == Op::kTransfer) go_on_transfer();
    for (at = next(); at <= now_; at = next()) go_on_program();
  } while (goes_on(at));
}

void NativeCpu::go_on_transfer() {
  Transfer& transfer = *request_.transfer;
  if (transfer.done()) return;
  while (!transfer.done() && transfer.next() <= now_) transfer.run(now_);
  if (transfer.done()) ready_at_ = now_ + timing_.overhead;
}

void NativeCpu::go_on_program() {
  if (request_.op == Op::kAccess) end_access();
  request_.op = Op::kNone;
  fiber_.resume();
  if (!std::exchange(begun_, false)) take_request();
}

/// No other agent has a turn up to `at`: continue there in this turn.
bool NativeCpu::goes_on(Tick at) {
  if (at == refused_ || others == nullptr) return false;
  if (others->go_on(at)) return true;
  refused_ = at;
  return false;
}

/// Starts the request that the program made before it suspended.
void NativeCpu::take_request() {
  switch (request_.op) {
    case Op::kNone:
      ready_at_ = bus::kNever;  // ended
      break;
    case Op::kAccess: begin_access(); break;
    case Op::kSetRReq:
      bus_.set_r_req(now_, request_.level);
      ready_at_ = now_ + timing_.pin_write;
      break;
    case Op::kSetRSta:
      if (request_.level) bus_.looked(looks_);
      bus_.set_r_sta(now_, request_.level);
      ready_at_ = now_ + timing_.pin_write;
      break;
    case Op::kLReq:
      sampled_ = bus_.l_req(now_);
      looks_.l_req = now_;
      ready_at_ = now_ + timing_.pin_sample;
      break;
    case Op::kLSta:
      sampled_ = bus_.l_sta(now_);
      looks_.l_sta = now_;
      ready_at_ = now_ + timing_.pin_sample;
      break;
    case Op::kLamps:
      lamps_ = bus_.lamps(now_);
      ready_at_ = now_ + timing_.pin_sample;
      break;
    case Op::kWait: ready_at_ = request_.until; break;
    case Op::kTransfer: go_on_transfer(); break;
  }
}

void NativeCpu::begin_access() {
  const bool own_timing = request_.access.write && timing_.write_access;
  bus_.begin(now_, request_.access, own_timing ? *timing_.write_access : timing_.access);
  ready_at_ = bus_.end() + timing_.overhead;
  // Each of its edges has a turn, with two exceptions: all are executed in this turn if no other agent has one before
  // the last, and all in the last turn if no other agent observes them.
  const bool in_one_go = others != nullptr && others->quiet_until() > bus_.end();
  put_off_ = others != nullptr && !in_one_go && bus_.put_off();
  if (put_off_) return;
  const Tick until = in_one_go ? bus_.end() : now_;
  if (in_one_go || bus_.next_edge() <= until) run_edges(until);
}

/// A chip that is not ready makes the access longer.
void NativeCpu::run_edges(Tick until) {
  bus_.run_edges(until);
  ready_at_ = std::max(ready_at_, bus_.end() + timing_.overhead);
}

void NativeCpu::end_access() {
  if (std::exchange(put_off_, false)) bus_.run_edges(bus_.end());
  ++counters_.accesses;
  if (!request_.access.write && bus_.last_read_was_bad()) ++counters_.bad_reads;
}

void NativeCpu::intr0_changed(Tick at, bool level) {
  if (level) return;
  interrupt_at_ = std::min(interrupt_at_, at + timing_.interrupt_latency);
  intr0_at_ = std::min(intr0_at_, at);
  announce();
}

void NativeCpu::wake(Tick at) {
  wake_at_ = std::min(wake_at_, at);
  announce();
}

// ------------------------------------------------------------------------------------------------- the program's side

void NativeCpu::perform(const Request& request) {
  request_ = request;
  if (!made_at_once()) fiber_.suspend();
  serve_interrupt();
}

/// On the program's stack, in this turn: if the pins may be moved there, and no other agent has a turn up to its end.
bool NativeCpu::made_at_once() {
  if (request_.op >= Op::kWait || others == nullptr || !bus_.is_used_from_anywhere() || fiber_.unwinding())
    return false;
  take_request();
  begun_ = !is_over_by_itself() || (ready_at_ > now_ && !goes_on(ready_at_));
  if (begun_) return false;
  now_ = std::max(now_, ready_at_);
  if (request_.op == Op::kAccess) end_access();
  request_.op = Op::kNone;
  return true;
}

/// Only time has to pass.
bool NativeCpu::is_over_by_itself() const {
  return request_.op != Op::kAccess || (!put_off_ && bus_.next_edge() == bus::kNever);
}

void NativeCpu::serve_interrupt() {
  while (interrupt_is_due()) {
    interrupt_at_ = bus::kNever;
    in_handler_ = true;
    ++counters_.interrupts;
    const bool sampled = sampled_;
    handler_();
    sampled_ = sampled;
    in_handler_ = false;
  }
}

std::uint8_t NativeCpu::read(std::uint16_t address) {
  request_ = {Op::kAccess, {false, address, 0}, false, 0, nullptr};
  if (!made_at_once()) fiber_.suspend();
  const std::uint8_t value = bus_.read_value();  // before a handler reads another
  serve_interrupt();
  return value;
}

void NativeCpu::write(std::uint16_t address, std::uint8_t value) {
  perform({Op::kAccess, {true, address, value}, false, 0, nullptr});
}

void NativeCpu::set_r_req(bool level) { perform({Op::kSetRReq, {}, level, 0, nullptr}); }

void NativeCpu::set_r_sta(bool level) { perform({Op::kSetRSta, {}, level, 0, nullptr}); }

bool NativeCpu::l_req() {
  perform({Op::kLReq, {}, false, 0, nullptr});
  return sampled_;
}

bool NativeCpu::l_sta() {
  perform({Op::kLSta, {}, false, 0, nullptr});
  return sampled_;
}

unsigned NativeCpu::lamps() {
  perform({Op::kLamps, {}, false, 0, nullptr});
  return lamps_;
}

void NativeCpu::transfer(Transfer& transfer) { perform({Op::kTransfer, {}, false, 0, &transfer}); }

void NativeCpu::transfer_changed() {
  announce();
  if (on_announce) on_announce();
}

/// Suspends until `at` or an earlier break; interrupts due then have been served on return.
void NativeCpu::suspend_until(Tick at, Break reason) {
  break_ = reason;
  perform({Op::kWait, {}, false, at, nullptr});
}

/// No other agent has a turn, and no pin is observed, until then: the program continues without the bench.
bool NativeCpu::passes_at_once(Tick at) {
  break_ = Break::kInterrupt;
  return at < break_tick() && goes_on(at);
}

void NativeCpu::wait_until(Tick at) {
  if (now_ < at && passes_at_once(at)) now_ = at;
  while (now_ < at) suspend_until(at, Break::kInterrupt);
}

bool NativeCpu::wait_for_wake(Tick until) {
  while (now_ < until && wake_at_ > now_) suspend_until(until, Break::kWake);
  const bool woken = wake_at_ <= now_;
  if (woken) wake_at_ = bus::kNever;
  return woken;
}

bool NativeCpu::wait_intr0(Tick until) {
  while (now_ < until && intr0_at_ > now_) suspend_until(until, Break::kIntr0);
  const bool fell = intr0_at_ <= now_;
  if (fell) intr0_at_ = bus::kNever;
  return fell;
}

void NativeCpu::on_intr0(std::function<void()> handler) {
  handler_ = std::move(handler);
  interrupt_at_ = bus::kNever;
}

void NativeCpu::enable_interrupts(bool enabled) {
  enabled_ = enabled;
  serve_interrupt();
}

}  // namespace dsdpv1::user_cpu
