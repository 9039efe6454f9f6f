#include "kinds/dsdpv1/checks/checks.hpp"

#include <utility>

namespace dsdpv1::checks {
namespace {

constexpr std::uint32_t kPortPins =
    mask(Pin::kCsr) | mask(Pin::kRd) | mask(Pin::kWr) | mask(Pin::kA) | mask(Pin::kDIn) | mask(Pin::kDOut);

}  // namespace

void Checks::pin(Tick at, Pin pin, Level level) {
  if ((dsdpv1::mask(pin) & pins_) == 0) return;
  history_.add(at, static_cast<tb::PinNumber>(pin), level);
  const bool is_port = !serial() && (dsdpv1::mask(pin) & kPortPins) != 0;
  is_port ? port_pin(at, pin, level) : other_pin(at, pin, level);
}

void Checks::other_pin(Tick at, Pin pin, Level level) {
  if (strap(pin, level)) return;
  if (pin == Pin::kReset)
    reset_pin(at, level != 0);
  else if (pin == Pin::kIntr0)
    intr0_pin(at, level != 0);
  else if (pin == Pin::kPbrts)
    station_.drives(at, level != 0);
  else if (!serial())
    parallel_pin(at, pin, level);
  else if (settings_.mode == kUart)
    uart_.pin(at, pin, level);
  else if (!in_reset_)
    spi_pin(at, pin, level);
}

void Checks::pins(const tb::PinEdge* first, const tb::PinEdge* last) {
  for (; first != last; ++first) pin(first->at, static_cast<Pin>(first->pin), first->level);
}

bool Checks::strap(Pin pin, Level level) {
  switch (pin) {
    case Pin::kMode: settings_.mode = level; return true;
    case Pin::kAdr: settings_.address = level; return true;
    case Pin::kUbr: settings_.rate = level; return true;
    case Pin::kUiv: settings_.interval = level; return true;
    default: return false;
  }
}

bool Checks::applies(CheckId check) const {
  if (check == Check::kLookInWindow) return !serial() && ownership_.judges_looks();
  if (check.index < CheckId(kFirstCommonCheck).index) return !serial();
  if (check == Check::kUserRefused) return duties_.judges_refusals();
  if (check.index < CheckId(kFirstSpiCheck).index) return true;
  return settings_.mode == (check.index < CheckId(kFirstUartCheck).index ? kSpi : kUart);
}

void Checks::intr0_pin(Tick at, bool level) {
  if (in_reset_) return;
  if (!serial()) end_hold_before(at);
  service_.intr0(at, level);
  duties_.intr0(at, level);
}

void Checks::spi_pin(Tick at, Pin pin, Level level) {
  spi_.pin(at, pin, level);
  frames_.pin(at, pin, level);
}

/// Most changes.
void Checks::port_pin(Tick at, Pin pin, Level level) {
  if (hold_end_) end_hold_before(at);
  port_.pin(at, pin, level);
}

void Checks::parallel_pin(Tick at, Pin pin, Level level) {
  end_hold_before(at);
  switch (pin) {
    case Pin::kRReq:
    case Pin::kRSta: return handshake(at, pin, level != 0);
    case Pin::kLSta: return ownership_.l_sta(at, level != 0);
    default: return;
  }
}

/// In reset the port neither reads nor writes (P10), and all running measurements end.
void Checks::reset_pin(Tick at, bool level) {
  if (level && in_reset_) recorder_.value(Check::kResetLow, at, at - reset_fell_, [] { return std::string(); });
  if (!level) reset_fell_ = at;
  in_reset_ = !level;
  holding_ = false;
  hold_end_.reset();
  ownership_.reset(at, in_reset_);
  port_.reset(in_reset_);
  cells_.reset();
  station_.reset();
  service_.reset();
  spi_.reset();
  frames_.reset();
  uart_.reset(at, in_reset_);
  duties_.reset();  // a reply on the UART may have ended before
}

void Checks::handshake(Tick at, Pin pin, bool level) {
  const std::optional<Tick> since = ownership_.held_off_since();
  pin == Pin::kRReq ? ownership_.r_req(at, level) : ownership_.r_sta(at, level);
  if (in_reset_) return;
  if (pin == Pin::kRSta && level && !std::exchange(holding_, true)) {
    cells_.hold_began();
    duties_.hold_began(at);
  }
  if (ownership_.held_off_since()) {
    hold_end_.reset();  // a release of zero length does not count
  } else {
    if (since) service_.held_off(*since, at);
    if (holding_) hold_end_ = at;
  }
}

void Checks::end_hold_before(Tick at) {
  if (!hold_end_ || *hold_end_ >= at) return;
  cells_.hold_ended(*hold_end_);
  duties_.hold_ended(*hold_end_, HoldOf::kDpram);
  hold_end_.reset();
  holding_ = false;
}

void Checks::access_began(Tick at) {
  if (!in_reset_) ownership_.access_began(at);
}

void Checks::access_ended(Tick at) {
  if (!in_reset_) ownership_.access_ended(at);
}

void Checks::accessed(const Access& access) {
  if (in_reset_) return;
  cells_.accessed(access);
  service_.accessed(access);
  duties_.accessed(access);
}

void Checks::telegram(Tick now, const bus::WireTelegram& telegram) {
  recorder_.now(now);
  station_.telegram(telegram);
  if (settings_.mode == kSpi && !in_reset_) frames_.telegram(now, telegram);
  if (settings_.mode == kUart) uart_.pass(now);
  if (!serial()) {
    end_hold_before(now);
    service_.telegram(now, telegram, ownership_.held_off_since());
  }
  if (!in_reset_) duties_.telegram(now, telegram);
}

void Checks::event(const profibus::Event& event) {
  if (in_reset_) return;
  if (!serial()) end_hold_before(event.at);
  duties_.event(event, settings_.mode == kSpi    ? Refusals::Port::kSpi
                       : settings_.mode == kUart ? Refusals::Port::kUart
                                                 : Refusals::Port::kParallel);
}

void Checks::finish(Tick end) {
  recorder_.now(end);
  if (in_reset_) return;
  finish_port(end);
  duties_.finish(end);
}

void Checks::finish_port(Tick end) {
  if (settings_.mode == kUart) return uart_.finish(end);
  if (settings_.mode == kSpi) {
    spi_.finish(end);
    return frames_.finish(end);
  }
  end_hold_before(end + 1);
  service_.finish(end, ownership_.held_off_since());
  ownership_.finish(end);
}

}  // namespace dsdpv1::checks
