#pragma once
// Characters of the wire: start bit, eight data bits LSB first, even parity, stop bit (EN 50170). Independent of the
// chip's receiver, so that one checks the other. Lengths inside a character are in 1/1000 bit ("millibits").
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "bus/baud.hpp"
#include "bus/bytes.hpp"
#include "bus/time.hpp"
#include "bus/wire/segment.hpp"

namespace dsdpv1::bus {

/// The line inverted for a while, measured from the start of the character.
struct Glitch {
  int start_millibits = 0;
  int length_millibits = 0;
};

/// One character as it is sent, whole or deliberately broken.
struct Character {
  std::uint16_t bits = 0;          ///< levels in the order of sending, bit 0 first
  int bit_count = kCharacterBits;  ///< number of bits sent, 1..16; afterwards the line is idle
  int gap_millibits = 0;           ///< idle time before the first bit
  std::optional<Glitch> glitch = {};

  static Character of(std::uint8_t byte);
  static Character wrong_parity(std::uint8_t byte);
  /// The stop bit is low (a framing error).
  static Character without_stop(std::uint8_t byte);
  /// Nothing is broken.
  bool right() const;
  std::uint8_t byte() const { return static_cast<std::uint8_t>(bits >> 1); }
};

/// Faults to inject into a telegram on the wire; none by default. Positions count bytes from 0; those after the end
/// have no effect.
struct WireFaults {
  std::optional<std::size_t> wrong_parity_at = {};
  std::optional<std::size_t> missing_stop_at = {};
  std::optional<std::size_t> gap_before = {};  ///< `gap_millibits` of idle before this byte
  int gap_millibits = 0;
  std::optional<std::size_t> truncate_after = {};  ///< only this many whole characters are sent ...
  int truncate_bits = 0;                           ///< ... and this many bits of the next one
  std::optional<std::size_t> glitch_at = {};       ///< `glitch` in this character
  Glitch glitch = {};
};

std::vector<Character> characters(const Bytes& bytes, const WireFaults& faults = {});

/// Sends characters back to back; valid ones as a run if all stations on the segment take it. Edges are rounded from
/// the exact time since the first start bit, so nothing drifts.
class UartSender {
 public:
  /// Sends as `station` of `segment`, which must outlive the sender.
  UartSender(Segment& segment, StationId station) : segment_(segment), station_(station) {}

  /// `bit` in ticks; `ppm` makes every bit longer (positive: a slow clock) by so many millionths. Not while busy.
  void set_timing(Tick bit, std::int64_t ppm = 0);
  /// Time that the driver is enabled before the first start bit and after the last bit. Default 0.
  void set_driver_times(Tick lead, Tick trail);
  /// The first start bit falls at `start` (not before now + lead). Not while busy.
  void send(Tick start, const std::vector<Character>& characters);
  /// As above, with valid characters.
  void send(Tick start, const Bytes& bytes);
  /// Call when the station's listener gets run_cut: the rest is sent by changes. Changes `next()`.
  void run_cut(Tick at);
  /// Releases the line at once and drops the rest.
  void abort(Tick now);

  bool busy() const { return position_ < edges_.size(); }
  /// End of the last bit of the last `send`.
  Tick end() const { return end_; }
  Tick next() const { return !busy() ? kNever : offers_run() ? start_ : edges_[position_].at; }
  void run(Tick now);

 private:
  struct Edge {
    Tick at;
    bool enabled, level;
  };
  enum class Run : std::uint8_t {
    kNone,      ///< sent by edges
    kOffered,   ///< at the first start bit
    kUnderWay,  ///< taken by the listeners
  };
  Tick exact(std::int64_t millibits) const;
  void begin(Tick start, std::int64_t millibits);
  bool offers_run() const { return run_state_ == Run::kOffered && position_ > 0; }
  void offer_run();
  void spell_out(const std::vector<Character>& characters);
  void spell_out_run();
  void add_character(std::int64_t start_millibits, const Character& character);
  void add_level(Tick at, bool level);

  Segment& segment_;
  StationId station_;
  Tick bit_ = baud(0).bit, lead_ = 0, trail_ = 0, start_ = 0, end_ = 0;
  std::int64_t ppm_ = 0;
  std::vector<Edge> edges_;  ///< of the driver and, without a run, of the characters
  std::size_t position_ = 0;
  Bytes run_;  ///< the characters, when they may be sent as a run
  Run run_state_ = Run::kNone;
};

struct ReceivedCharacter {
  std::uint8_t byte = 0;
  Tick start = 0;  ///< falling edge of the start bit
  Tick end = 0;    ///< 11 nominal bit times later
  bool parity_ok = true, stop_ok = true;

  bool ok() const { return parity_ok && stop_ok; }
};

/// Samples every bit in its middle, counted from the falling edge of the start bit.
class UartReceiver {
 public:
  void set_bit(Tick bit) { bit_ = bit; }
  /// Drops a character in progress; the line has this level now.
  void reset(bool level);
  /// Returns whether `next()` has changed: a character has begun or ended.
  bool line_changed(Tick at, bool level);
  /// Replaces the changes of a run that begins now; false: the changes are needed. Its characters are reported in the
  /// middle of the last one's stop bit, or with `each` in the middle of their own.
  bool set_run(const CharacterRun& run, bool each = false);
  /// Changes after `at` are reported by line_changed.
  void cut_run(Tick at);
  /// The middle of the stop bit of a character in progress, where it is reported.
  Tick next() const { return in_run_ ? next_report() : receiving_ ? sample_at(kCharacterBits - 1) : kNever; }
  void run(Tick now);
  bool receiving() const { return receiving_ || in_run_; }

  /// Called for a character, valid or not, in the middle of its stop bit.
  std::function<void(const ReceivedCharacter&)> on_character;
  /// Called at the same place for a run that was not cut. If unset or false, its characters are reported one by one.
  std::function<bool(const CharacterRun&)> on_run;
  /// Called for a start bit that was high again in its middle; `at` is its falling edge.
  std::function<void(Tick at)> on_false_start;

 private:
  Tick sample_at(int bit) const { return start_ + bit * bit_ + bit_ / 2; }
  void begin(Tick at);
  Tick complete_at(std::size_t index) const { return run_.character(index + 1) - bit_ / 2; }
  Tick next_report() const { return complete_at(each_ ? reported_ : run_.size - 1); }
  void report_run(Tick until);
  void end_run(Tick before);
  void sample_until(Tick end);
  void sample();
  void finish();

  Tick bit_ = baud(0).bit, start_ = 0;
  bool level_ = true, receiving_ = false;
  int sampled_ = 0;
  std::uint16_t bits_ = 0;
  CharacterRun run_;
  Bytes run_bytes_;
  bool in_run_ = false, each_ = false;
  std::size_t reported_ = 0;  ///< characters of the run
};

}  // namespace dsdpv1::bus
