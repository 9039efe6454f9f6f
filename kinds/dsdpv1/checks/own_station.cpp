#include "kinds/dsdpv1/checks/own_station.hpp"

namespace dsdpv1::checks {

void OwnStation::reset() {
  address_.reset();
  sending_ = false;
}

void OwnStation::pbrts(Tick at, bool level) {
  sending_ = level;
  (level ? pbrts_rose_ : pbrts_fell_) = at;
}

bool OwnStation::is_framed(const bus::WireTelegram& telegram) const {
  return telegram.tsdr && pbrts_rose_ <= telegram.start && (sending_ || pbrts_fell_ >= telegram.end) &&
         pbrts_rose_ != 0;
}

void OwnStation::telegram(const bus::WireTelegram& telegram) {
  if (is_framed(telegram)) address_ = telegram.station;
}

bool OwnStation::is_asked(const bus::WireTelegram& telegram) const {
  if (!telegram.right() || !address_) return false;
  const bus::Telegram& request = telegram.decoded.telegram;
  return request.is_request() && request.da == *address_;
}

bool OwnStation::is_exchange(const bus::WireTelegram& telegram) const {
  if (!is_asked(telegram)) return false;
  const bus::Telegram& request = telegram.decoded.telegram;
  const bool srd = request.function() == bus::fc::kSrdLow || request.function() == bus::fc::kSrdHigh;
  return srd && !request.dsap;
}

bool OwnStation::answers(const bus::WireTelegram& telegram) const {
  return address_ && telegram.tsdr && telegram.right() && telegram.station == *address_;
}

}  // namespace dsdpv1::checks
