#pragma once
// Collects complete, valid telegrams of other stations while a master does not await an answer.
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
  /// Sets the ticks per bit; drops a telegram in progress.
  void set_bit(Tick bit);
  /// Drops a telegram in progress.
  void reset();
  /// Returns a result if the character completes a valid telegram. After an invalid telegram or character everything is
  /// ignored until the line has been idle for T_SYN.
  std::optional<HeardTelegram> feed(const ReceivedCharacter& received);

 private:
  Tick bit_ = baud(0).bit, start_ = 0, last_end_ = 0;
  TelegramDecoder decoder_;
  bool skipping_ = false;
};

}  // namespace dsdpv1::bus
