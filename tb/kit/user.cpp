#include "tb/kit/user.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "tb/bench/program_options.hpp"

namespace dsdpv1::kit {

void OnSegment::reset_host(Tick at) {
  for (std::size_t i = 0; i < parts_.pins.size(); ++i)
    if (parts_.pins[i].direction == kInput) set(at, static_cast<PinNumber>(kOwn + i), parts_.pins[i].rest);
}

void OnSegment::set(Tick at, PinNumber pin, Level level) {
  in_users_turn_ = true;
  set_pin(at, pin, level);
  in_users_turn_ = false;
}

Program::Program(const Parts& parts, OwnPins& pins, const tb::OwnSettings& settings, const tb::OwnSettings& chip,
                 const user_cpu::ProgramOptions& options, Tick start)
    : parts_(parts), pins_(pins), settings_(settings), chip_settings_(chip), options_(options) {
  pins_.on_change = [this](Tick at, PinNumber pin, Level level) { pin_changed(at, pin, level); };
  begin(start + options.start_delay);
}

void Program::begin(Tick at) {
  due_ = at;
  waits_interrupt_ = waits_change_ = false;
  interrupt_at_ = bus::kNever;
  fiber_ = std::make_unique<user_cpu::Fiber>([this] { parts_.program(*this); });
}

// --- the bench's side ------------------------------------------------------------------------------------------------

Tick Program::next() const {
  if (stopped_ || fiber_->ended()) return bus::kNever;
  return std::max(now_, waits_interrupt_ ? std::min(due_, interrupt_at_) : due_);
}

void Program::run(Tick now) {
  now_ = now;
  while (next() <= now_) fiber_->resume();
}

void Program::interrupt_changed(Tick at, bool level) {
  const Level rest = parts_.pins[*parts_.interrupt - kOwn].rest;
  if ((level ? 1 : 0) == rest) return;
  interrupt_at_ = std::min(interrupt_at_, at);
  announce();
}

void Program::pin_changed(Tick at, PinNumber pin, Level level) {
  if (hear_) hear_(at, pin, level);
  if (!waits_change_ || at >= due_) return;
  due_ = at;
  announce();
  if (on_plan) on_plan();
}

void Program::command(Tick now, const user_cpu::Command& command) {
  now_ = std::max(now_, now);
  std::visit([this](const auto& each) { carry_out(each); }, command);
  announce();
}

void Program::carry_out(const user_cpu::command::SetDiagnosis& set) {
  diagnosis_ = Diagnosis{tb::diagnosis_code(set.kind), set.bytes};
}

/// Its next actions at the pins are dropped.
void Program::carry_out(const user_cpu::command::Reinitialise& again) {
  options_.station = again.station;
  fiber_.reset();
  for (std::size_t i = 0; i < parts_.pins.size(); ++i)
    if (parts_.pins[i].direction == kInput) set(static_cast<PinNumber>(kOwn + i), parts_.pins[i].rest);
  begin(now_);
}

// --- the program's side ----------------------------------------------------------------------------------------------

/// In this turn, if no other agent has one up to then.
void Program::wait_until(Tick at) {
  if (at <= now_) return;
  if (!fiber_->unwinding() && others() != nullptr && others()->go_on(at)) {
    now_ = at;
    return;
  }
  due_ = at;
  fiber_->suspend();
}

bool Program::wait_interrupt(Tick until) {
  waits_interrupt_ = true;
  due_ = until;
  if (next() > now_) fiber_->suspend();
  waits_interrupt_ = false;
  if (interrupt_at_ > now_) return false;
  interrupt_at_ = bus::kNever;
  return true;
}

void Program::wait_change(Tick until) {
  if (until <= now_) return;
  waits_change_ = true;
  due_ = until;
  fiber_->suspend();
  waits_change_ = false;
}

std::vector<std::uint8_t> Program::inputs(std::size_t length) {
  std::vector<std::uint8_t> bytes = inputs_.next(length, outputs_, length);
  bytes.resize(length);
  return bytes;
}

std::optional<user_cpu::command::OfChip> Program::order() {
  if (orders_.empty()) return std::nullopt;
  user_cpu::command::OfChip next = std::move(orders_.front());
  orders_.pop_front();
  return next;
}

void Program::received(std::vector<std::uint8_t> outputs) {
  outputs_ = std::move(outputs);
  ++counters_.program->outputs_received;
}

void Program::written() {
  ++counters_.program->inputs_written;
  ++counters_.program->exchanges;
}

void Program::failed(const std::string& code, const std::string& text) {
  ++counters_.program->driver_errors;
  if (on_error) on_error({now_, code, text});
}

}  // namespace dsdpv1::kit
