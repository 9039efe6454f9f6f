#include "model/dsdpv1/host_uart.hpp"

#include <algorithm>

#include "model/dsdpv1/reasons.hpp"

namespace dsdpv1 {
namespace {

using profibus::kBitsPerCharacter;
using profibus::kNever;

constexpr std::uint8_t kDataExchBit = 0x01, kErrorBit = 0x80;  // function of a reply

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
    report_falls(now);  // what it receives at this edge is without effect
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

// When the line has been silent too long, as far as its changes are noted.
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

// While nothing is heard.
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

// --- telegrams -------------------------------------------------------------------------------------------------------

void HostUart::judge(Cycle now, const ChipSide& side) {
  judge_at_ = kNever;
  state_ = State::kReply;
  const std::uint8_t tsdr = ram_.read(regs::kUartTsdr);
  earliest_ = request_end_ - 2 + Cycle{std::max<std::uint32_t>(config_.uart_min_tsdr, tsdr)} * bit_;
  size_ = 0;
  std::uint8_t code = kCrcWrong;
  if (request_.crc_right())
    code = telegram_.judge(request_, now, log_);
  else
    log_.at_cycle(now, Reason::kTelegramCrc, request_.crc, request_.computed);
  if (code != 0) return reply_error(now, code, side.data_exch);
  carry_out(now);
  commit_.eval(now, side.owns, side.data_exch);
}

void HostUart::carry_out(Cycle now) {
  switch (request_.command) {
    case Command::kRead: return commit_.read(now, request_);
    case Command::kWrite: return commit_.write(now, request_, telegram_.data(), HostCommit::kNobody);
    case Command::kExchange: return commit_.exchange(now, request_, telegram_.data());
  }
}

void HostUart::reply_error(Cycle now, std::uint8_t code, bool data_exch) {
  const auto address = static_cast<std::uint8_t>(address_);
  if (request_.command == Command::kExchange) {
    add(address);
    add(kErrorBit | (data_exch ? kDataExchBit : std::uint8_t{0}));
  } else {
    add(0xE0 | address);
  }
  add(code);
  send(now);
}

// The last move is made.
void HostUart::reply_done(Cycle now) {
  const auto address = static_cast<std::uint8_t>(address_);
  if (request_.command == Command::kExchange) {
    const Exchange& answer = commit_.answer();
    const std::uint8_t head[] = {address, answer.function(), static_cast<std::uint8_t>(answer.address() >> 8),
                                 static_cast<std::uint8_t>(answer.address() & 0xFF), answer.length_byte()};
    add(head, sizeof head);
    add(answer.data(), answer.size());
  } else {
    add((request_.command == Command::kRead ? 0x80 : 0xA0) | address);
    add(0);
    if (request_.command == Command::kRead) add(commit_.data(), request_.length);
  }
  send(now);
}

void HostUart::send(Cycle ready) {
  const std::uint16_t crc = dpram::crc16(reply_.data(), size_);
  add(static_cast<std::uint8_t>(crc >> 8));
  add(static_cast<std::uint8_t>(crc & 0xFF));
  tx_.send(reply_.data(), size_, bit_, std::max(earliest_, ready + 1), 0, 0);
}

}  // namespace dsdpv1
