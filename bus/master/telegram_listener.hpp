#pragma once
// What a master hears while it does not await an answer: whole, right telegrams of others.
#include <optional>

#include "bus/telegram/telegram.hpp"
#include "bus/time.hpp"
#include "bus/wire/uart.hpp"

namespace dsdpv1::bus {

struct HeardTelegram {
  Telegram telegram = {};
  Tick start = 0, end = 0;  ///< falling edge of the first start bit, end of the last stop bit
};

class TelegramListener {
 public:
  /// Ticks of a bit; forgets a telegram begun.
  void set_bit(Tick bit);
  /// Forgets a telegram begun.
  void reset();
  /// A result when the character completes a right telegram. Behind a wrong one, or a wrong character, nothing counts
  /// until the line was idle for T_SYN.
  std::optional<HeardTelegram> feed(const ReceivedCharacter& received);

 private:
  Tick bit_ = baud(0).bit, start_ = 0, last_end_ = 0;
  TelegramDecoder decoder_;
  bool skipping_ = false;
};

}  // namespace dsdpv1::bus
