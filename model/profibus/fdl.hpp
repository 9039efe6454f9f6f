#pragma once
// FDL: the addressee of a telegram, SAP bytes, and the answer repeated to a repetition (EN 50170; rulings S3, S20, S21,
// S26).
#include "model/profibus/dp_slave.hpp"
#include "model/profibus/event_log.hpp"
#include "model/profibus/request.hpp"
#include "model/profibus/telegram_rx.hpp"

namespace dsdpv1::profibus {

/// Which request with FCV = 1 is a repetition: the one with SA and FCB of the last, or with all that S26 compares.
enum class FcbRule : std::uint8_t { kLetter, kContent };

class Fdl {
 public:
  Fdl(EventLog& log, FcbRule rule) : log_(log), rule_(rule) {}

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
    auto& [log, rule, memory, frame] = *this;
    archive.given(log, rule);
    archive(memory, frame);
  }

 private:
  /// The values that identify a repeated request; the letter needs only SA and FCB of them (S26).
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
  bool same_content(const Telegram& telegram, const Request& request) const;
  bool remembers(std::uint8_t code, bool moved) const;
  void log_repetition(Cycle now, const Telegram& telegram, const Request& request);

  EventLog& log_;
  const FcbRule rule_;
  Memory memory_;
  Frame answer_;  // the last one
};

}  // namespace dsdpv1::profibus
