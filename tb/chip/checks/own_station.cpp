#include "tb/chip/checks/own_station.hpp"

namespace dsdpv1::checks {
namespace {

std::uint8_t fcs_of(const bus::Bytes& bytes) { return bytes.size() < 2 ? std::uint8_t{0} : bytes[bytes.size() - 2]; }

bool repeats(const bus::WireTelegram& request, const bus::WireTelegram& earlier) {
  const bus::Telegram &one = request.decoded.telegram, &other = earlier.decoded.telegram;
  const bus::Bytes &bytes = request.decoded.bytes, &others = earlier.decoded.bytes;
  return (one.fc & bus::fc::kFcv) != 0 && one.sa == other.sa && one.fc == other.fc && bytes.size() == others.size() &&
         fcs_of(bytes) == fcs_of(others);
}

}  // namespace

void OwnStation::reset() { *this = {}; }

void OwnStation::drives(Tick at, bool on) {
  driving_ = on;
  (on ? began_ : ended_) = at;
}

bool OwnStation::is_framed(const bus::WireTelegram& telegram) const {
  return telegram.tsdr && began_ != 0 && began_ <= telegram.start && (driving_ || ended_ >= telegram.end);
}

void OwnStation::telegram(const bus::WireTelegram& telegram) {
  if (is_framed(telegram)) address_ = telegram.station;
  answered_ = false;
  if (is_asked(telegram)) {
    open_ = !repeats(telegram, request_);
    if (open_) request_ = telegram;
  } else if (open_ && answers(telegram)) {
    open_ = false;
    answered_ = true;
  }
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
