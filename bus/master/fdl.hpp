#pragma once
// Data link layer of a master: one request at a time, with its answer, times, repetitions and FCB.
#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bus/master/slave_parameters.hpp"
#include "bus/master/telegram_listener.hpp"
#include "bus/telegram/telegram.hpp"
#include "bus/wire/uart.hpp"

namespace dsdpv1::bus {

enum class FdlOutcome : std::uint8_t {
  kSent,       ///< a telegram without answer has been sent
  kAnswered,   ///< by a valid telegram; it may be a refusal (UE, RR, RS)
  kNoAnswer,   ///< nothing within the slot time, not even to the repetitions
  kBadAnswer,  ///< the last attempt got an invalid answer
  kAborted,    ///< the master was stopped or lost the token before the end of the request
};

struct FdlResult {
  FdlOutcome outcome = FdlOutcome::kNoAnswer;
  Telegram request = {};                    ///< with FCB and FCV as sent; empty for raw bytes that are not a telegram
  Telegram answer = {};                     ///< with kAnswered
  Bytes raw = {};                           ///< bytes of the last answer, valid or not
  Tick request_start = 0, request_end = 0;  ///< of the last attempt
  Tick answer_start = 0, answer_end = 0;    ///< with an answer
  int retries = 0;                          ///< repetitions sent
  int timeouts = 0;                         ///< attempts without any answer
  int errors = 0;                           ///< attempts with a wrong answer
  bool read_back = true;  ///< for a token: the line carried the bytes sent; else another station is sending

  bool answered() const { return outcome == FdlOutcome::kAnswered; }
  bool short_acknowledge() const { return answered() && answer.kind == TelegramKind::kSc; }
};

struct FdlRequest {
  /// FC holds bit 6 and the function; FCB and FCV are added for SDA, SRD and MSRD.
  Telegram telegram = {};
  /// Sent instead of `telegram`, unchanged and without repetition.
  std::optional<std::vector<Character>> raw = {};
  bool wants_answer = true;  ///< for `raw`
  /// For a token: kSent only if its receiver (or any station) is heard within the slot time, else kNoAnswer.
  bool await_activity = false;
};

class MasterFdl : public Listener {
 public:
  /// Attaches to the segment, which must outlive it. `address` 0..126.
  MasterFdl(Segment& segment, const std::string& name, std::uint8_t address, const BusParameters& parameters);
  MasterFdl(const MasterFdl&) = delete;
  MasterFdl& operator=(const MasterFdl&) = delete;

  /// 0..9. Only while idle. Characters of other stations are received at the new rate from `now` on.
  void set_baud(Tick now, int index);
  bool idle() const { return state_ == State::kIdle; }
  /// Sends as soon as the idle times allow. Only while idle.
  void start(Tick now, FdlRequest request);
  /// Falls silent at once; a running request ends with kAborted.
  void abort(Tick now);
  /// The next request to `address` starts a new series (FCB = 1, FCV = 0).
  void restart_series(std::uint8_t address) { series_.at(address) = {}; }
  /// An answer of this station to a request that ended at `request_end`, sent min_TSDR later. Only while idle; no
  /// on_done.
  void respond(Tick request_end, const Telegram& answer);
  /// No request starts before `at`.
  void not_before(Tick at) {
    ready_at_ = std::max(ready_at_, at);
    plan_changed();
  }
  /// End of the last character received or sent.
  Tick last_activity() const { return last_activity_; }

  Tick next() const;
  void run(Tick now);
  void line_changed(Tick at, bool level) override;
  bool run_begins(const CharacterRun& run) override;
  void run_cut(Tick at, bool level) override;

  /// Called once for every `start`, when the layer is idle again.
  std::function<void(const FdlResult&)> on_done;
  /// Called for telegrams of other stations that are not answers to this one. If set, a request or a token of another
  /// master instead of the answer ends the request with kAborted: two masters have the token.
  std::function<void(const HeardTelegram&)> on_heard;
  /// Called when a call other than `run` may have changed `next()`.
  std::function<void()> on_plan;

 private:
  enum class State : std::uint8_t {
    kIdle,
    kWaitBus,  ///< until the line has been idle long enough
    kSending,
    kWaitAnswer,     ///< until the first character or the end of the slot time
    kAwaitActivity,  ///< after a token: the same, for any station
    kReceiving,
    kResponding,  ///< until min_TSDR has passed; then kSending
    kDraining,    ///< after a wrong answer, until the line has been idle for T_SYN
  };
  struct Series {
    bool started = false;
    bool fcb = true;  ///< for the next request
  };
  Tick bits(Tick count) const { return count * bit_; }
  Tick earliest_start() const;
  Tick quiet_deadline() const { return last_activity_ + bits(kSynBits); }
  void compose();
  void send(Tick now);
  void sent();
  void character(const ReceivedCharacter& received);
  void take(const Decoded& decoded);
  bool take_run(const CharacterRun& run);
  void listen(const ReceivedCharacter& received);
  void plan_changed() const {
    if (on_plan) on_plan();
  }
  bool reads_back() const { return on_heard && request_.telegram.kind == TelegramKind::kSd4 && !request_.raw; }
  bool answers_request(const Telegram& answer) const;
  void succeed();
  void no_answer(Tick now);
  void wrong_answer(Tick now);
  void retry_or(FdlOutcome outcome, Tick now);
  void finish(FdlOutcome outcome);
  void deadline(Tick now);

  std::uint8_t address_;
  BusParameters parameters_;
  Segment& segment_;
  StationId station_;
  UartSender sender_;
  UartReceiver receiver_;
  TelegramDecoder decoder_;
  TelegramListener listener_;
  int baud_ = 0;
  Tick bit_ = 0;

  State state_ = State::kIdle;
  FdlRequest request_;
  Bytes bytes_;  ///< of the telegram as sent
  Bytes echo_;   ///< of a token, as received while it was sent
  bool responding_ = false;
  bool wants_answer_ = false;
  FdlResult result_;
  Tick last_activity_ = 0, ready_at_ = 0, slot_end_ = 0;
  std::array<Series, 128> series_ = {};
};

}  // namespace dsdpv1::bus
