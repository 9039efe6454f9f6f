#pragma once
// FDL: the addressee of a telegram, SAP bytes, and the answer repeated to a repetition (EN 50170; rulings S3, S20, S21,
// S26).
#include "model/profibus/dp_slave.hpp"
#include "model/profibus/event_log.hpp"
#include "model/profibus/request.hpp"
#include "model/profibus/telegram_rx.hpp"

namespace dsdpv1::profibus {

class Fdl {
 public:
  explicit Fdl(EventLog& log) : log_(log) {}

  /// Forgets the last request and its answer.
  void forget() { memory_.valid = false; }
  /// True if `telegram` is a well formed request for `address` or for all; fills `request`.
  bool addressed(Cycle now, const Telegram& telegram, std::uint8_t address, Request& request);
  /// Executes the request, or recognises a repetition. Returns the frame to be sent, null for none.
  const Frame* execute(Cycle now, const Telegram& telegram, const Request& request, DpSlave& slave);
  /// The answer to the request executed last.
  const Frame& answer() const { return answer_; }

  template <class Archive>
  void store(Archive& archive) {
    auto& [log, memory, frame] = *this;
    archive.given(log);
    archive(memory, frame);
  }

 private:
  /// The values that identify a repeated request (S26).
  struct Memory {
    bool valid = false;
    std::uint8_t sa = 0, fc = 0, fcs = 0;
    int dsap = kNoSap, ssap = kNoSap, size = 0;

    template <class Archive>
    void store(Archive& archive) {
      auto& [right, from, code, sum, to_sap, from_sap, length] = *this;
      archive(right, from, code, sum, to_sap, from_sap, length);
    }
  };
  bool take_saps(Cycle now, const Telegram& telegram, Request& request);
  bool repetition(const Telegram& telegram, const Request& request) const;

  EventLog& log_;
  Memory memory_;
  Frame answer_;  // the last one
};

}  // namespace dsdpv1::profibus
