#include "bus/master/telegram_listener.hpp"

namespace dsdpv1::bus {

void TelegramListener::set_bit(Tick bit) {
  bit_ = bit;
  reset();
}

void TelegramListener::reset() {
  decoder_.finish();
  skipping_ = false;
}

std::optional<HeardTelegram> TelegramListener::feed(const ReceivedCharacter& received) {
  if (received.start - last_end_ >= kSynBits * bit_) reset();
  last_end_ = received.end;
  skipping_ = skipping_ || !received.ok();
  if (skipping_) return std::nullopt;
  if (!decoder_.begun()) start_ = received.start;
  const auto decoded = decoder_.feed(received.byte);
  if (!decoded) return std::nullopt;
  skipping_ = decoded->error != DecodeError::kNone;
  if (skipping_) return std::nullopt;
  return HeardTelegram{decoded->telegram, start_, received.end};
}

}  // namespace dsdpv1::bus
