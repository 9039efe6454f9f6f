#include "lab/replay/lead_in.hpp"

#include "bus/baud.hpp"

namespace dsdpv1::tb::replay {
namespace {

/// An address that is not the model's, highest first.
std::uint8_t other_than(std::uint8_t avoid) {
  return static_cast<std::uint8_t>(avoid == bus::kHighestAddress ? avoid - 1 : bus::kHighestAddress);
}

}  // namespace

LeadIn::LeadIn(bus::Segment& segment, int baud, std::uint8_t avoid, std::function<bool(int baud)> found)
    : sender_(segment, segment.attach("lead-in", nullptr)),
      request_(bus::encode(bus::make_telegram(other_than(avoid), static_cast<std::uint8_t>(avoid == 0 ? 1 : 0),
                                              bus::fc::kRequest | bus::fc::kFdlStatus))),
      found_(std::move(found)) {
  set_baud(baud);
}

void LeadIn::set_baud(int baud) {
  baud_ = baud;
  pause_ = (bus::baud(baud).slot_bits + bus::kSynBits) * bus::baud(baud).bit;
  sender_.set_timing(bus::baud(baud).bit);
}

void LeadIn::search(int baud, Tick now) {
  set_baud(baud);
  due_ = now + pause_;
  give_up_ = now + kLongest;
  ended_ = false;
  telegrams_.clear();
  next_telegram_ = 0;
  announce();
}

Tick LeadIn::next() const {
  if (sender_.busy()) return sender_.next();
  return ended_ ? bus::kNever : due_;
}

void LeadIn::run(Tick now) {
  if (sender_.busy()) return sender_.run(now);
  constexpr Tick kForUser = 5 * bus::kTicksPerMs;
  if (wanted_ && next_telegram_ == 0 && !found_(baud_) && now < give_up_) return send(now, request_);
  if (wanted_ && next_telegram_ < telegrams_.size()) {
    const bus::Telegram& telegram = telegrams_[next_telegram_++];
    send(now, bus::encode(telegram));
    on_sent(telegram, sender_.end());
    due_ += kForUser;
    return;
  }
  ended_ = true;
  on_end(now);
}

void LeadIn::send(Tick now, const bus::Bytes& bytes) {
  sender_.send(now, bus::characters(bytes));
  sender_.run(now);
  due_ = sender_.end() + pause_;
}

}  // namespace dsdpv1::tb::replay
