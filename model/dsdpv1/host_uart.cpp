#include "model/dsdpv1/host_uart.hpp"

#include <algorithm>

#include "model/dsdpv1/reasons.hpp"

namespace dsdpv1 {
namespace {

using profibus::kBitsPerCharacter;
using profibus::kNever;

}  // namespace

void HostUart::reset() {
  state_ = State::kOff;
  commit_.reset();
  tx_.abort();
  judge_at_ = kNever;
}

void HostUart::start(Cycle now, int address, int rate, int interval) {
  address_ = address;
  interval_ = interval;
  bit_ = kUbrCycles.at(static_cast<std::size_t>(rate & 7));
  take_interval(interval);
  state_ = State::kWait;
  rx_.restart(bit_, now, now);
}

void HostUart::set_rxd(Tick at, bool level) {
  const Cycle done = at / profibus::kTicksPerCycle;
  if (state_ == State::kOff) rx_.skip(done);
  if (rx_.full()) rx_.eval(done);
  rx_.set_line(at, level);
}

Cycle HostUart::next() const {
  switch (state_) {
    case State::kOff: return kNever;
    case State::kReply: return std::min({rx_.next_change(), commit_.next(), tx_.next()});
    default: return std::min({rx_.next(), silence_at(), judge_at_});
  }
}

void HostUart::eval(Cycle now, const ChipSide& side) {
  if (state_ == State::kReply) {
    report_falls(now);
    if (commit_.eval(now, side.owns, side.data_exch)) reply_done(now);
    if (!tx_.planned() || tx_.next() != now) return;
    tx_.eval(now);
    if (now != tx_.end()) return;
    rx_.restart(bit_, now, now);
    state_ = State::kWait;
    return;
  }
  if (now == judge_at_ && telegram_.is_for(address_)) {
    judged_ = now;
    fall_reported_ = false;
    report_falls(now);  // characters received at this edge have no effect
    return judge(now, side);
  }
  if (now == judge_at_) judge_at_ = kNever;
  receive(now);
}

// --- characters ------------------------------------------------------------------------------------------------------

void HostUart::receive(Cycle now) {
  if (rx_.eval(now)) hand_over(now);
  if (silence_at() <= now && state_ != State::kWait) silence(now);
}

void HostUart::hand_over(Cycle now) {
  const profibus::Character& character = rx_.character();
  if (state_ == State::kDeaf) return;
  if (state_ == State::kWait) {
    telegram_.restart();
    const std::uint8_t code = ram_.read(regs::kUartInterval);
    take_interval(code >= 1 && code <= 7 ? code : interval_);
  }
  if (!character.stop_ok) return spoil(now, Reason::kUartFraming);
  if (!character.parity_ok) return spoil(now, Reason::kUartParity);
  const bool complete = telegram_.add(character.value);
  if (!telegram_.is_telegram()) {
    log_.at_cycle(now, Reason::kTelegramStart, character.value);
    state_ = State::kDeaf;
    return;
  }
  state_ = complete ? State::kWait : State::kIn;
  if (!complete) return;
  request_ = telegram_.request();
  request_end_ = character.start + Cycle{kBitsPerCharacter} * bit_;
  judge_at_ = now + 1;
}

void HostUart::spoil(Cycle now, profibus::Reason reason) {
  log_.at_cycle(now, reason, static_cast<unsigned>(telegram_.count()), rx_.character().value);
  state_ = State::kDeaf;
}

void HostUart::take_interval(int code) {
  const Cycle half_characters = config_.uart_gaps.at(static_cast<std::size_t>(code));
  gap_ = half_characters * kBitsPerCharacter * bit_ / 2;
}

// The cycle at which the line has been silent too long, according to the changes noted so far.
Cycle HostUart::silence_at() const {
  const Cycle idle = rx_.idle_since();
  if (idle == kNever || state_ == State::kWait) return kNever;
  const Cycle at = idle + gap_ + 1;
  return rx_.next_change() > at ? at : kNever;
}

void HostUart::silence(Cycle now) {
  if (state_ == State::kIn)
    log_.at_cycle(now, Reason::kTelegramCut, static_cast<unsigned>(telegram_.count()),
                  static_cast<unsigned>(telegram_.bytes()));
  state_ = State::kWait;
}

// While the receiver is deaf.
void HostUart::report_falls(Cycle now) {
  while (rx_.next_change() <= now) {
    const Cycle at = rx_.next_change();
    const bool falls = rx_.line();
    rx_.skip(at);
    if (!falls || fall_reported_) continue;
    fall_reported_ = true;
    log_.at_cycle(at, Reason::kUartHalfDuplex, static_cast<unsigned>(std::min<Cycle>(at - judged_, 0xFFFF)));
  }
}

}  // namespace dsdpv1
