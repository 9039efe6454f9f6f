#pragma once
// From characters to error-free telegrams (ruling S3, S10): start delimiters, lengths, FCS, ED, T_SYN and gaps.
#include <array>

#include "model/profibus/addressee.hpp"
#include "model/profibus/event_log.hpp"
#include "model/profibus/uart_rx.hpp"

namespace dsdpv1::profibus {

namespace sd {
constexpr std::uint8_t kSd1 = 0x10, kSd2 = 0x68, kSd3 = 0xA2, kSd4 = 0xDC, kSc = 0xE5, kEd = 0x16;
}

/// An error-free telegram; `data` points into the receiver and is valid until the next one starts.
struct Telegram {
  std::uint8_t sd = 0, da = 0, sa = 0, fc = 0, fcs = 0;
  const std::uint8_t* data = nullptr;
  int size = 0;
  Cycle end = 0;        ///< calculated end of the last stop bit
  bool synced = false;  ///< preceded by T_SYN; answers of other stations are not
  int idle_bits = 0;    ///< whole bit times of idle before it; a large number is not exact

  /// `from`: the bytes into which `data` points, `most` plus one.
  template <class Archive>
  void store(Archive& archive, const std::uint8_t* from, int most) {
    auto& [delimiter, to, sender, function, sum, bytes, length, ended, after_syn, idle] = *this;
    archive(delimiter, to, sender, function, sum, after_syn, idle);
    archive.within(0, kMostData, length);
    archive.place(bytes, from, most - kMostData);
    archive.cycles(ended);
    archive.check(length == 0 || bytes != nullptr);
  }
  static constexpr int kMostData = 246;  ///< LE of 249 less DA, SA, FC
};

class TelegramRx {
 public:
  explicit TelegramRx(EventLog& log) : log_(log) {}

  /// Everything as at power-on.
  void reset();
  /// Forgets the telegram in progress.
  void restart();
  /// The chip's own answer begins at `now`: the telegram in progress is lost.
  void cut(Cycle now);
  /// While `quiet`, faulty telegrams are neither reported nor counted, because at a wrong baud rate all are faulty.
  /// Resets the count.
  void set_quiet(bool quiet);
  /// True when idle with nothing to report. A complete valid telegram can then be fed with character() alone, even
  /// late, up to the edge after its last character.
  bool takes_whole() const { return !in_telegram() && unsynced_ == 0; }
  /// Feeds all characters with character(): the first came after `idle` cycles, the last ended at `end`. Returns false
  /// and does nothing if `idle` cannot precede a telegram.
  bool take_whole(const std::uint8_t* bytes, int size, Cycle idle, Cycle end, int bit);
  /// As above, for a telegram whose content is not needed, including the edge of decided(), if no character begins
  /// before it.
  bool pass_whole(Cycle idle, int bit);
  /// When a telegram that ended at `end` is decided, if no character begins before.
  static Cycle decided(Cycle end, int bit) { return end + bit + 1; }
  /// A character was completed at `now`.
  void character(Cycle now, const Character& character, int bit);
  /// The edge of `now`; `receiving`: a character is being sampled. Returns true when a telegram is decided (S10): see
  /// telegram().
  bool eval(Cycle now, bool receiving);
  /// When the telegram in progress is decided, if no character begins before; kNever without one.
  Cycle deadline() const { return in_telegram() ? deadline_ : kNever; }
  const Telegram& telegram() const { return telegram_; }

  template <class Archive>
  void store(Archive& archive) {
    auto& [log, state, quiet, given_up, unsynced, count, expected, deadline, bytes, telegram] = *this;
    archive.given(log);
    archive.within(State::kWaitSyn, State::kComplete, state);
    archive(quiet, given_up, bytes);
    archive.within(0U, kMostUnsynced, unsynced);
    archive.within(0, kMostBytes - 1, count, expected);
    archive.cycles(deadline);
    telegram.store(archive, bytes.data(), kMostBytes - 1);
    archive.check(is_possible());
  }

 private:
  enum class State : std::uint8_t { kWaitSyn, kReceiving, kComplete };
  bool in_telegram() const { return state_ != State::kWaitSyn; }
  void begin_telegram(Cycle idle, int bit);
  void begin(Cycle now, std::uint8_t value);
  void take(Cycle now, std::uint8_t value);
  bool check_sd2_header(Cycle now, std::uint8_t value);
  void check_end(Cycle now);
  void fail(Cycle now, Reason reason, unsigned a = 0, unsigned b = 0);
  void count_unsynced();
  void report_unsynced(Cycle now);
  bool is_possible() const;

  EventLog& log_;
  State state_ = State::kWaitSyn;
  bool quiet_ = true;
  bool given_up_ = false;  // characters that follow without a gap belong to a telegram already reported or counted
  unsigned unsynced_ = 0;  // faulty telegrams without T_SYN, not reported yet (S8)
  int count_ = 0, expected_ = 0;
  Cycle deadline_ = kNever;
  static constexpr int kMostBytes = 256;
  static constexpr unsigned kMostUnsynced = 0xFFFF;  // an event's numbers have 16 bits
  std::array<std::uint8_t, kMostBytes> bytes_{};
  Telegram telegram_;
};

}  // namespace dsdpv1::profibus
