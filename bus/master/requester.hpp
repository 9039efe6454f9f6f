#pragma once
// A scripted requester for conformance tests: sends any bytes at an exact time and reports the characters received.
#include <optional>
#include <string>
#include <vector>

#include "bus/telegram/telegram.hpp"
#include "bus/timeline.hpp"
#include "bus/wire/segment.hpp"
#include "bus/wire/uart.hpp"

namespace dsdpv1::bus {

struct ExchangeOptions {
  std::optional<Tick> at = {};  ///< falling edge of the first start bit; not before the timeline's now
  int idle_bits = kSynBits;     ///< without `at`: idle since the last activity, bit times
  WireFaults faults = {};
  bool wants_answer = true;  ///< false: returns at the end of the request
  std::optional<int> slot_bits =
      {};  ///< how long to wait for the first character; default the slot time of the baud rate
};

struct Exchange {
  Tick request_start = 0, request_end = 0;
  Tick bit = 0;                                    ///< ticks of a bit at the requester's rate
  std::vector<ReceivedCharacter> characters = {};  ///< of the answer, valid or not
  Bytes raw = {};                                  ///< their bytes
  Decoded decoded = {DecodeError::kTruncated};     ///< the answer; kTruncated also without one

  bool silent() const { return characters.empty(); }
  /// One valid telegram without character errors.
  bool answered() const;
  bool short_acknowledge() const { return answered() && decoded.telegram.kind == TelegramKind::kSc; }
  const Telegram& answer() const { return decoded.telegram; }
  /// The following are only valid if not silent.
  Tick answer_start() const { return characters.front().start; }
  Tick answer_end() const { return characters.back().end; }
  /// From the end of the request's last stop bit to the answer's start bit, ticks.
  Tick tsdr() const { return answer_start() - request_end; }
  double tsdr_bits() const { return static_cast<double>(tsdr()) / static_cast<double>(bit); }
};

class Requester : public Listener, public Agent {
 public:
  /// Attaches to the segment, which must outlive it; add it to the timeline passed to `send`.
  explicit Requester(Segment& segment, const std::string& name = "requester");
  Requester(const Requester&) = delete;
  Requester& operator=(const Requester&) = delete;

  /// 0..9, default 0; `ppm` is the error of the sender's clock (positive: slow).
  void set_baud(int index, std::int64_t ppm = 0);
  Tick bit() const { return bit_; }
  /// End of the last character sent or received.
  Tick last_activity() const { return last_activity_; }

  /// Sends, then runs the timeline until the answer is complete (or cut off: T_SYN of silence) or the slot time has
  /// passed. Throws std::invalid_argument if `options.at` is in the past.
  Exchange send(Timeline& timeline, const Bytes& bytes, const ExchangeOptions& options = {});
  Exchange send(Timeline& timeline, const Telegram& telegram, const ExchangeOptions& options = {});
  /// Sends raw bit patterns; `options.faults` are not applied.
  Exchange send(Timeline& timeline, const std::vector<Character>& characters, const ExchangeOptions& options = {});

  void line_changed(Tick at, bool level) override;
  bool run_begins(const CharacterRun& run) override;
  void run_cut(Tick at, bool level) override;
  Tick next() const override { return sender_.busy() ? sender_.next() : receiver_.next(); }
  void run(Tick now) override;

 private:
  Tick start_time(const Timeline& timeline, const ExchangeOptions& options) const;
  void send_all(Timeline& timeline);
  void await_answer(Timeline& timeline, const ExchangeOptions& options);
  void receive_until(Timeline& timeline, Tick limit, std::size_t characters);
  void character(const ReceivedCharacter& received);

  Segment& segment_;
  StationId station_;
  UartSender sender_;
  UartReceiver receiver_;
  int baud_ = 0;
  Tick bit_ = 0, last_activity_ = 0;
  bool listening_ = false, decided_ = false;
  TelegramDecoder decoder_;
  Exchange exchange_;
};

}  // namespace dsdpv1::bus
