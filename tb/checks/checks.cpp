#include "tb/checks/checks.hpp"

namespace checks {

using dsdpv1::Level;
using dsdpv1::Pin;

void Checks::pin(Tick at, Pin pin, Level level) {
  constexpr std::uint32_t kInputs = ~dsdpv1::kOutputPins & ~dsdpv1::mask(Pin::kPbrxd);  // the monitor hears the line
  if ((dsdpv1::mask(pin) & (kPins | kInputs)) == 0) return;
  history_.add(at, pin, level);
  end_hold_before(at);
  switch (pin) {
    case Pin::kReset: return reset_pin(level != 0);
    case Pin::kRReq: return r_req(at, level != 0);
    case Pin::kRSta: return r_sta(at, level != 0);
    case Pin::kLSta: return ownership_.l_sta(at, level != 0);
    case Pin::kIntr0: return service_.intr0(at, level != 0);
    case Pin::kPbrts: return service_.pbrts(at, level != 0);
    case Pin::kCsr:
    case Pin::kRd:
    case Pin::kWr:
    case Pin::kA:
    case Pin::kDIn:
    case Pin::kDOut: return port_.pin(at, pin, level);
    default: return;
  }
}

/// In reset the port neither reads nor writes (P10), and whatever was going on is over.
void Checks::reset_pin(bool level) {
  in_reset_ = !level;
  hold_end_.reset();
  ownership_.reset();
  port_.reset();
  cells_.reset();
  service_.reset();
}

void Checks::r_req(Tick at, bool level) {
  const std::optional<Tick> since = ownership_.requested_since();
  ownership_.r_req(at, level);
  if (!level && since && !in_reset_) service_.request_ended(*since, at);
}

void Checks::r_sta(Tick at, bool level) {
  if (in_reset_) return ownership_.r_sta(at, level);
  end_hold_before(at + 1);
  if (level) cells_.hold_began();
  ownership_.r_sta(at, level);
  if (!level) hold_end_ = at;
}

void Checks::end_hold_before(Tick at) {
  if (!hold_end_ || *hold_end_ >= at) return;
  cells_.hold_ended(*hold_end_);
  hold_end_.reset();
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
}

void Checks::telegram(Tick now, const bus::WireTelegram& telegram) {
  recorder_.now(now);
  end_hold_before(now);
  service_.telegram(telegram, ownership_.requested_since());
}

void Checks::finish(Tick end) {
  recorder_.now(end);
  if (in_reset_) return;
  end_hold_before(end + 1);
  ownership_.finish(end);
  service_.finish(end);
}

}  // namespace checks
