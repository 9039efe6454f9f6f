#pragma once
// A listener that decodes everything on the wire, with times, and flags violations.
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "bus/telegram/telegram.hpp"
#include "bus/timeline.hpp"
#include "bus/token/token_watch.hpp"
#include "bus/wire/segment.hpp"
#include "bus/wire/uart.hpp"

namespace dsdpv1::bus {

enum class FlagKind : std::uint8_t {
  kCollision,         ///< two drivers on the line at once
  kGap,               ///< idle time between two characters of a telegram
  kSynViolated,       ///< a request began less than T_SYN (33 bit times) after the last activity
  kTsdrEarly,         ///< an answer before min_TSDR
  kTsdrLate,          ///< an answer after max_TSDR
  kCharacterError,    ///< wrong parity or stop bit
  kTelegramError,     ///< see DecodeError
  kUnanswered,        ///< no answer within the slot time
  kUnexpectedAnswer,  ///< an answer that was not requested, or from the wrong station
  kGlitch,            ///< a low level shorter than half a bit
  kTwoMasters,        ///< a master sends while another has the token
};
constexpr std::size_t kFlagKinds = 11;
/// "collision", "gap", ... for logs and results.
const char* name(FlagKind kind);

struct Flag {
  FlagKind kind{};
  Tick at = 0;       ///< place of detection
  std::string text;  ///< as text, with the measured value
};

struct WireTelegram {
  Tick start = 0;   ///< falling edge of the first start bit
  Tick end = 0;     ///< end of the last stop bit
  int baud = 0;     ///< index of the table in bus/baud.hpp
  Decoded decoded;  ///< with the bytes
  bool character_errors = false;
  std::optional<Tick> tsdr = {};  ///< answers to a request: from the end of the request to the start bit
  std::uint8_t station = 255;     ///< the answering station; for SC the station that was asked; 255 = not an answer

  bool right() const { return decoded.error == DecodeError::kNone && !character_errors; }
  /// TSDR in bit times, with fraction. Only with a `tsdr`.
  double tsdr_bits() const;
};

/// TSDR of one station, in ticks.
struct StationStatistics {
  std::uint64_t requests = 0;  ///< to this station, repetitions included
  std::uint64_t answers = 0;   ///< valid ones
  std::uint64_t unanswered = 0;
  Tick tsdr_min = kNever, tsdr_max = 0, tsdr_sum = 0;

  /// 0 without answers.
  Tick tsdr_mean() const { return answers == 0 ? 0 : tsdr_sum / static_cast<Tick>(answers); }
};

struct MonitorStatistics {
  std::uint64_t telegrams = 0;  ///< valid ones
  std::uint64_t wrong = 0;
  std::array<std::uint64_t, 5> by_kind = {};         ///< valid ones by TelegramKind
  std::array<std::uint64_t, kFlagKinds> flags = {};  ///< by FlagKind
  std::map<std::uint8_t, StationStatistics> stations = {};
};

/// Limits for answers, in bit times. The defaults are those of the baud rate.
struct TsdrLimits {
  int min_bits = kMinTsdrBits;
  std::optional<int> max_bits = {};
};

class Monitor : public Listener, public Agent {
 public:
  /// Attaches to the segment and its collisions (also calls an on_collision set before). The segment, the monitor and
  /// its timeline must live equally long.
  explicit Monitor(Segment& segment);
  Monitor(const Monitor&) = delete;
  Monitor& operator=(const Monitor&) = delete;

  /// The rate of the wire from now on, 0..9; a telegram in progress is dropped. Default 0 (12 Mbit/s).
  void set_baud(int index);
  int baud() const { return baud_; }
  /// For answers of one station (Set_Prm may have changed min_TSDR), or of all others.
  void set_limits(std::uint8_t station, const TsdrLimits& limits) { station_limits_[station] = limits; }
  void set_limits(const TsdrLimits& limits) { limits_ = limits; }
  /// True for answers, by their start, whose time says nothing of their station: T_SDR is neither measured nor judged.
  std::function<bool(Tick start)> untimed;
  /// Slot time after which a request counts as unanswered, bit times; default that of the baud rate.
  void set_slot_bits(std::optional<int> bits) {
    slot_bits_ = bits;
    announce();
  }
  /// Largest idle time between characters that is not flagged as a gap, 1/1000 bit. Default 1000 (ruling S10).
  void set_gap_tolerance(int millibits) { gap_tolerance_ = millibits; }

  std::function<void(const WireTelegram&)> on_telegram;
  std::function<void(const Flag&)> on_flag;
  /// Called for each character, before its effects; null: not reported.
  std::function<void(const ReceivedCharacter&)> on_character;
  /// Called for a character after an invalid telegram, before the line has been idle for T_SYN: it counts as part of
  /// that telegram.
  std::function<void(const ReceivedCharacter&)> on_skipped;

  const MonitorStatistics& statistics() const { return statistics_; }
  /// T_RR of each master, by its address.
  const std::map<std::uint8_t, RotationStatistics>& rotations() const { return token_.rotations(); }

  void line_changed(Tick at, bool level) override {
    if (receiver_.line_changed(at, level)) announce();
  }
  bool run_begins(const CharacterRun& run) override;
  void run_cut(Tick at, bool /*level*/) override {
    announce();
    receiver_.cut_run(at);
  }
  Tick next() const override;
  void run(Tick now) override;

 private:
  struct Pending {
    Tick end;
    std::uint8_t da;
  };
  Tick bits(Tick count) const { return count * bit_; }
  Tick idle_at() const;
  Tick slot_end() const;
  void character(const ReceivedCharacter& received);
  bool take_run(const CharacterRun& run);
  void idle_before(Tick start);
  void begin_telegram(Tick start);
  void check_character(const ReceivedCharacter& received);
  void finish_telegram(Decoded decoded);
  void classify(WireTelegram& telegram);
  void request(const WireTelegram& wire);
  void answer(WireTelegram& wire);
  void measure(const WireTelegram& telegram);
  void check_syn(const WireTelegram& telegram);
  void check_token(const WireTelegram& telegram);
  Tick slot() const;
  void count(const WireTelegram& telegram);
  void idle();
  void give_up_waiting(Tick now);
  void flag(FlagKind kind, Tick at, std::string text);
  std::string in_bits(Tick ticks) const;

  UartReceiver receiver_;
  TelegramDecoder decoder_;
  int baud_ = 0;
  Tick bit_ = bus::baud(0).bit;
  int gap_tolerance_ = 1000;
  std::optional<int> slot_bits_;
  TsdrLimits limits_;
  std::map<std::uint8_t, TsdrLimits> station_limits_;

  WireTelegram current_;            ///< of the telegram in progress
  bool skipping_ = false;           ///< after an invalid telegram: until the line has been idle for T_SYN
  bool active_ = false;             ///< the line has not been idle for T_SYN since last_end_
  std::optional<Tick> last_end_;    ///< end of the last character, none before the first
  std::optional<Tick> quiet_from_;  ///< end of the activity before the telegram in progress
  std::optional<Pending> pending_;  ///< the request that awaits its answer
  TokenWatch token_;
  MonitorStatistics statistics_;
};

/// One line for a log: start time in ns, baud rate, TSDR, the telegram as text, or its fault and its bytes.
std::string format_line(const WireTelegram& telegram);
std::string format_line(const Flag& flag);

}  // namespace dsdpv1::bus
