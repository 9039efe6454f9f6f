#include "lab/calibrate/supervision.hpp"

#include "lab/calibrate/dp_service.hpp"

namespace dsdpv1::calibrate {
namespace {

using State = Supervised::State;

/// Cycles; 0: none.
double watchdog_of(const bus::Bytes& prm) {
  constexpr std::uint8_t kWdOn = 0x08, kWdBase1ms = 0x04;
  if ((prm[0] & kWdOn) == 0) return 0;
  const bool base = prm.size() > kPrmSize && (prm[kPrmSize] & kWdBase1ms) != 0;
  return prm[1] * prm[2] * (base ? 1 : 10) * kCyclesPerMs;
}

/// An error-free telegram to the station: one that it answers, or an SDN after T_SYN.
bool is_heard(const Exchange& exchange) {
  if (exchange.answer != nullptr) return true;
  return !exchange.request->telegram.wants_answer() && exchange.request->telegram.sa != bus::kBroadcast &&
         (!exchange.idle || exchange.idle->lo >= bus::kSynBits);
}

}  // namespace

Span since(const TimeBase& time, const Moment& moment, Tick at) {
  const Span distance = time.between(moment.edge, at);
  return {distance.lo - moment.offset.hi, distance.hi - moment.offset.lo};
}

const Supervised& Supervision::before(Tick at) {
  for (; exchange_ < all_.exchanges.size(); ++exchange_) {
    const Exchange& exchange = all_.exchanges[exchange_];
    if (since(time_, decision_of(*exchange.request), at).lo <= 0) break;
    rate_found(exchange.request->end());
    take(exchange);
  }
  rate_found(at - 1);
  return now_;
}

void Supervision::take(const Exchange& exchange) {
  if (!exchange.request->right && exchange.answer != nullptr) {  // the station has read it
    now_.state = State::kUnknown;
    if (may_be_prm(exchange)) now_.prm.reset();
    if (now_.prm) now_.prm->heard.reset();
  }
  if (!exchange.is_request() || !is_heard(exchange)) return;
  const Moment now = decision_of(*exchange.request);
  end_watchdog(now);
  trigger(exchange.request->telegram.sa, now);
  execute(exchange, now);
}

/// The watchdog's time may have passed before this telegram.
void Supervision::end_watchdog(const Moment& now) {
  if (now_.state != State::kDpControl) return;
  const Span passed = since(time_, now_.last, now.edge) + now.offset.lo;
  const double watchdog = now_.prm->watchdog;
  if (passed.hi + 1 < watchdog) return;
  if (passed.lo > watchdog)
    baud_control({now_.last.edge, now_.last.offset + watchdog});
  else
    now_.state = State::kUnknown;  // either may have been first
  now_.prm.reset();
}

void Supervision::trigger(std::uint8_t master, const Moment& now) {
  const bool holder = now_.prm && now_.prm->master == master;
  if (holder) now_.prm->heard = now;
  if (now_.state == State::kBaudControl || (now_.state == State::kDpControl && holder)) now_.last = now;
}

void Supervision::execute(const Exchange& exchange, const Moment& now) {
  const PrmKind prm = prm_kind(exchange);
  const bool no_watchdog = prm == PrmKind::kShort || prm == PrmKind::kUnlock || diagnosis_has(exchange, 0, kPrmReq) ||
                           (exchange.is_srd(std::nullopt) && exchange.refused(bus::fc::kRr));
  if (no_watchdog) {
    baud_control(now);
    now_.prm.reset();
  } else if (prm == PrmKind::kLock) {
    now_.prm = {watchdog_of(exchange.request->telegram.data), exchange.request->telegram.sa, now};
    now_.state = State::kUnknown;
  } else if (exchange.repeats) {
    return;  // nothing is executed
  } else if (exchange.is_srd(bus::sap::kChkCfg) && exchange.acknowledged()) {
    if (now_.state == State::kDpControl) now_.state = State::kUnknown;  // it may have been refused
  } else if (exchange.exchanged() && now_.prm && now_.prm->master == exchange.request->telegram.sa) {
    in_exchange(now);
  }
}

/// The parameters are in force.
void Supervision::in_exchange(const Moment& now) {
  now_.last = now;
  now_.state = now_.prm->watchdog != 0 ? State::kDpControl : State::kBaudControl;
}

void Supervision::baud_control(const Moment& now) {
  now_.state = State::kBaudControl;
  now_.last = now;
}

/// While the rate is searched no watchdog runs or starts.
void Supervision::rate_found(Tick at) {
  if (at <= searched_ || !rate_.seen) return;
  const std::size_t rise = rate_.last(at, true);
  if (rise != Trace::kNone && rate_.edges[rise] > searched_) {
    baud_control({rate_.edges[rise], {0, 0}});
    now_.prm.reset();
  }
  searched_ = at;
}

}  // namespace dsdpv1::calibrate
