#include "tb/replay/lead_in.hpp"

#include <utility>

#include "bus/baud.hpp"
#include "bus/telegram/telegram.hpp"

namespace tb::replay {
namespace {

/// An address that is not the model's, highest first.
std::uint8_t other_than(std::uint8_t avoid) {
  return static_cast<std::uint8_t>(avoid == bus::kHighestAddress ? avoid - 1 : bus::kHighestAddress);
}

}  // namespace

LeadIn::LeadIn(bus::Segment& segment, int baud, std::uint8_t avoid, bool wanted, std::function<bool()> found)
    : sender_(segment, segment.attach("lead-in", nullptr)),
      request_(bus::encode(bus::make_telegram(other_than(avoid), static_cast<std::uint8_t>(avoid == 0 ? 1 : 0),
                                              bus::fc::kRequest | bus::fc::kFdlStatus))),
      pause_((bus::baud(baud).slot_bits + bus::kSynBits) * bus::baud(baud).bit),
      wanted_(wanted),
      found_(std::move(found)) {
  sender_.set_timing(bus::baud(baud).bit);
}

Tick LeadIn::next() const {
  if (sender_.busy()) return sender_.next();
  return ended_ ? bus::kNever : due_;
}

void LeadIn::run(Tick now) {
  if (sender_.busy()) return sender_.run(now);
  if (!wanted_ || found_() || now >= kLongest) {
    ended_ = true;
    return on_end(now);
  }
  sender_.send(now, bus::characters(request_));
  sender_.run(now);
  due_ = sender_.end() + pause_;
}

}  // namespace tb::replay
