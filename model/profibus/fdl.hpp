#pragma once
// FDL: whom a telegram is for, SAP bytes, the frame count bit and the answer that a repetition gets again (EN 50170; rulings
// S3, S20, S21, S26).
#include "model/profibus/dp_slave.hpp"
#include "model/profibus/event_log.hpp"
#include "model/profibus/request.hpp"
#include "model/profibus/telegram_rx.hpp"

namespace profibus {

class Fdl {
 public:
  explicit Fdl(EventLog& log) : log_(log) {}

  /// Drops the memory of frame count bit and answer.
  void forget() { memory_.valid = false; }
  /// True when `telegram` is a request for `address` or for all, well formed: then `request` is filled.
  bool addressed(Cycle now, const Telegram& telegram, std::uint8_t address, Request& request);
  /// Executes the request, or recognises a repetition. The frame to be sent, null for none.
  const Frame* execute(Cycle now, const Telegram& telegram, const Request& request, DpSlave& slave);

 private:
  struct Memory {
    bool valid = false, fcb = false;
    std::uint8_t master = 0;
  };
  bool take_saps(Cycle now, const Telegram& telegram, Request& request);
  bool repetition(const Telegram& telegram, const Request& request) const;

  EventLog& log_;
  Memory memory_;
  Frame answer_;  // the last answer of a series, kept for its repetition
  Frame single_;  // answers outside a series (FDL status)
};

}  // namespace profibus
