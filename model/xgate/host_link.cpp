#include "model/xgate/host_link.hpp"

#include <algorithm>

namespace dsdpv1::xgate {
namespace {

constexpr Cycle kCyclesPerSecond = 1000 * profibus::kCyclesPerMs;
constexpr int kBitsPerByte = 10, kGapBytes = 10;

/// `bytes` characters at a rate, in cycles.
Cycle time_of(int bytes, std::uint32_t rate) { return bytes * kBitsPerByte * kCyclesPerSecond / rate; }

}  // namespace

void HostLink::reset() {
  parser_.drop();
  phase_ = Phase::kListening;
  gap_ends_ = rate_at_ = profibus::kNever;
  rate_ = config_.rate;
  new_rate_ = 0;
  overflow_ = fetching_ = false;
}

// --- the command -----------------------------------------------------------------------------------------------------

bool HostLink::receive(Cycle now, std::uint8_t byte) {
  if (phase_ != Phase::kListening) {
    overflow_ = true;
    return false;
  }
  take(now, byte);
  return true;
}

void HostLink::take(Cycle now, std::uint8_t byte) {
  const FrameParser::Got got = parser_.take(byte);
  const Cycle bytes = config_.port == Port::kUart ? time_of(kGapBytes, rate_) : 0;
  gap_ends_ = parser_.open() ? now + std::max(Cycle{config_.frame_gap}, bytes) : profibus::kNever;
  if (got == FrameParser::Got::kFrame) complete(now, error::kNone);
  if (got == FrameParser::Got::kWrongXor)
    complete(now, command().command == kInitialise ? error::kInitXor : error::kXor);
}

void HostLink::complete(Cycle now, Error fault) {
  fault_ = overflow_ ? error::kOverflow : fault;
  overflow_ = false;
  phase_ = Phase::kThinking;
  at_ = now + config_.answer_delay;
  gap_ends_ = profibus::kNever;
}

/// X4: the rest of a frame has not come.
void HostLink::gap(Cycle now) {
  const bool answered = parser_.has_command();
  parser_.drop();
  gap_ends_ = profibus::kNever;
  if (answered) complete(now, error::kTooFew);
}

// --- the answer ------------------------------------------------------------------------------------------------------

void HostLink::answer(Cycle now) {
  phase_ = Phase::kAnswering;
  at_ = now;
  sent_ = 0;
  if (config_.port == Port::kUart) report();
}

Cycle HostLink::byte_at(int place) const { return at_ + time_of(place, rate_); }

void HostLink::report() const {
  if (sink_.call == nullptr) return;
  sink_.call(sink_.self, byte_at(sent_), byte_at(sent_ + 1), wire_.bytes[static_cast<std::size_t>(sent_)]);
}

void HostLink::finish(Cycle now) {
  phase_ = Phase::kListening;
  if (new_rate_ != 0) rate_at_ = now + config_.rate_hold;
}

std::uint8_t HostLink::begin_byte() {
  fetching_ = phase_ == Phase::kAnswering;
  return fetching_ ? wire_.bytes[static_cast<std::size_t>(sent_)] : kIdle;
}

void HostLink::end_byte(Cycle now, std::uint8_t mosi) {
  if (phase_ == Phase::kListening) return take(now, mosi);
  if (!fetching_) return;  // the host waits for the answer
  fetching_ = false;
  if (++sent_ == wire_.size) finish(now);
}

// --- time ------------------------------------------------------------------------------------------------------------

void HostLink::eval(Cycle now) {
  if (now >= gap_ends_) gap(now);
  if (now >= rate_at_) {
    rate_ = new_rate_;
    new_rate_ = 0;
    rate_at_ = profibus::kNever;
  }
  if (phase_ != Phase::kAnswering || config_.port != Port::kUart || now < byte_at(sent_ + 1)) return;
  if (++sent_ == wire_.size)
    finish(now);
  else
    report();
}

Cycle HostLink::next() const {
  const Cycle line = std::min(gap_ends_, rate_at_);
  if (phase_ == Phase::kThinking) return std::min(line, at_);
  if (phase_ == Phase::kAnswering && config_.port == Port::kUart) return std::min(line, byte_at(sent_ + 1));
  return line;
}

}  // namespace dsdpv1::xgate
