#pragma once
// The receiving half of the UART bit engine: two flip-flops, start bit search, mid-bit sampling, even parity, stop bit
// (rulings P9, S2, S10). Edges of the line are only noted; a character is decided once, at its last sampling point,
// from the edges noted until then.
#include <array>

#include "model/profibus/baud.hpp"
#include "model/profibus/character_run.hpp"

namespace dsdpv1::profibus {

/// A sampled character.
struct Character {
  Cycle start = 0;  ///< the cycle at which the synchronised line fell
  Cycle idle = 0;   ///< idle cycles before `start`, from the calculated end of the stop bit before
  std::uint8_t value = 0;
  bool parity_ok = false;
  bool stop_ok = false;

  template <class Archive>
  void store(Archive& archive) {
    auto& [begin, before, byte, even, ended] = *this;
    archive.cycles(begin, before);
    archive(byte, even, ended);
  }
};

/// Times of changes of the line that may be passed late; none if `from` is kNever.
struct Unheard {
  Tick from = kNever, until = kNever;
};

/// Telegrams that need not be passed if they are passed as runs: valid ones (addressee()) from `from` on, at `bit`
/// cycles per bit, for a station other than `address` or for none. None if `from` is kNever.
struct Unconcerned {
  Tick from = kNever;
  Cycle bit = 0;
  std::uint8_t address = 0;
};

class UartRx {
 public:
  /// The line changes at `at`, not before an earlier call's. Pulses that no rising edge samples are lost. Not while
  /// full(). Returns false if next() and receiving() are unchanged, as for most edges within a character.
  bool set_line(Tick at, bool level);
  /// No room for another edge: eval() must use or skip() drop those that the logic has seen.
  bool full() const { return count_ == kDepth; }
  /// Follows the line up to `now` without receiving.
  void skip(Cycle now);

  /// Replaces set_line from now on, until the run is over or left: the line carries `run` at this receiver's bit
  /// length. Returns false if that is impossible now, or the run is too long or has another bit length. With `at_once`
  /// next() is the completion of its last character.
  bool set_run(const CharacterRun& run, bool at_once);
  /// The rest of the run, after `at`, is passed by set_line or does not occur.
  void leave_run(Tick at);
  /// The last level passed.
  bool input() const { return input_; }
  bool in_run() const { return run_index_ < run_size_; }
  /// The cycle from which the line is idle, unless a later change is passed; kNever during a character or a break.
  Cycle idle_from() const {
    if (in_run()) return run_end();
    return state_ == State::kIdle && count_ == 0 ? idle_since_ : kNever;
  }
  /// The line as seen by the logic, and its next change, which eval() or skip() takes.
  bool line() const { return line_; }
  Cycle next_change() const { return edge(); }
  /// Between two characters, as far as eval() has come: the start of the idle time; otherwise, and in a break, kNever.
  Cycle idle_since() const { return state_ == State::kIdle ? idle_since_ : kNever; }
  /// A run passed with `at_once` is complete at `now` and eval() has taken none of its characters: take_run() takes
  /// all.
  bool whole_run(Cycle now) const { return in_run() && at_once_ && run_index_ == 0 && next() <= now; }
  const std::uint8_t* run_bytes() const { return run_.data(); }
  int run_size() const { return run_size_; }
  /// Idle time before the run and its end, as seen by the logic, in cycles.
  Cycle run_idle() const { return run_start_ - idle_since_; }
  Cycle run_end() const { return run_start_ + Cycle{run_size_ - run_index_} * kBitsPerCharacter * bit_; }
  void take_run();
  /// A run was left by restart() or leave_run(), and forget_run() has not been called since.
  bool left_run() const { return left_run_; }
  void forget_run() { left_run_ = false; }

  /// Abandons a character in progress and samples with `bit` cycles per bit from `now` on. Idle counts from
  /// `idle_since` if the line is high, else from its next rise.
  void restart(int bit, Cycle now, Cycle idle_since);
  /// The edge of `now`. Returns true when a character is complete: see character(). Then call it again, because a run
  /// with `at_once` may have more.
  bool eval(Cycle now);
  /// The next edge at which eval() has a visible effect.
  Cycle next() const;
  /// Whether a character is being sampled at `at` or begins there, according to the noted edges. eval() was called up
  /// to now.
  bool receiving(Cycle at) const {
    return state_ == State::kReceiving || (state_ == State::kIdle && edge() <= at) || (in_run() && run_start_ <= at);
  }

  /// The time within which edges of the line may be passed late: before eval() is called for `until`'s cycle.
  Unheard unheard() const;
  /// The last sampling point of a character is at `now`.
  bool completes(Cycle now) const { return stop_sample() == now; }

  const Character& character() const { return character_; }
  /// The cycle at which the present character() was complete.
  Cycle completed() const { return character_.start + to_stop(); }
  int bit() const { return bit_; }

  template <class Archive>
  void store(Archive& archive) {
    auto& [edges, first, count, line, input, state, bit, index, shift, sample, idle_since, character, run, run_size,
           run_index, run_start, run_edge, at_once, left_run] = *this;
    for (Cycle& each : edges) archive.cycles(each);
    archive.within(0U, kDepth - 1, first);
    archive.within(0U, kDepth, count);
    archive.within(State::kIdle, State::kBreak, state);
    archive.within(1, kBitCycles[kBaudCount - 1], bit);
    archive.within(0, kStopIndex, index);
    archive.cycles(sample, idle_since, run_start);
    archive.ticks(run_edge);
    archive.within(0, kLongestRun, run_size, run_index);
    archive(line, input, shift, character, run, at_once, left_run);
  }

 private:
  static constexpr int kStopIndex = 10;
  enum class State : std::uint8_t { kIdle, kReceiving, kBreak };
  // A break has no end, so edges are consumed as they come; within a character at most ten count. More are noise, for
  // which set_line's caller makes room.
  static constexpr unsigned kDepth = 16;
  Cycle edge() const { return count_ > 0 ? edges_[first_] : kNever; }
  Cycle second_edge() const { return count_ > 1 ? edges_[(first_ + 1) % kDepth] : kNever; }
  void drop_edge() {
    first_ = (first_ + 1) % kDepth;
    --count_;
    line_ = !line_;
  }
  // For the character being received or beginning: the middle of its start bit until that has passed, and the last
  // sampling point; kNever until the noted edges confirm the start bit.
  Cycle start_sample() const;
  Cycle stop_sample() const;
  void take_edge();
  bool sample(Cycle end);
  Cycle to_stop() const { return bit_ / 2 + Cycle{kStopIndex} * bit_; }
  void note(Cycle visible);
  void take_from_run();
  void pass_characters(int count);

  std::array<Cycle, kDepth> edges_{};  // cycles at which the logic sees the line change, starting from line_
  unsigned first_ = 0, count_ = 0;
  bool line_ = true, input_ = true;

  State state_ = State::kIdle;  // kIdle: line_ is high
  int bit_ = kBitCycles[0];
  int index_ = 0;       // 0 start bit, 1..8 data, 9 parity, 10 stop
  unsigned shift_ = 0;  // start bit, data and parity, first bit lowest
  Cycle sample_ = kNever;
  Cycle idle_since_ = 0;
  Character character_;

  // Longer than any run: its sender has long forgotten it when the last character is complete.
  static constexpr int kLongestRun = 256;
  std::array<std::uint8_t, kLongestRun> run_{};
  int run_size_ = 0, run_index_ = 0;  // the first incomplete character; equal to the size: no run
  Cycle run_start_ = 0;               // its begin as seen by the logic ...
  Tick run_edge_ = 0;                 // ... and its start bit on the line
  bool at_once_ = false, left_run_ = false;
};

}  // namespace dsdpv1::profibus
