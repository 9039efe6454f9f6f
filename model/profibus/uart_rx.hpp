#pragma once
// The receiving half of the UART bit engine: start bit search, mid-bit sampling, even parity, stop bit (rulings S2,
// S10).
#include "model/profibus/baud.hpp"

namespace profibus {

/// A character as it was sampled.
struct Character {
  Cycle start = 0;  ///< the cycle at which the synchronised line fell
  Cycle idle = 0;   ///< idle cycles before `start`, from the calculated end of the stop bit before
  std::uint8_t value = 0;
  bool parity_ok = false;
  bool stop_ok = false;
};

class UartRx {
 public:
  /// Forgets a character in progress and samples with `bit` cycles a bit from now on. Idle counts from `idle_since` if
  /// the line is high, else from its next rise.
  void restart(int bit, Cycle idle_since, bool line);
  /// The edge of `now` with the synchronised line. True when a character is complete: see character().
  bool eval(Cycle now, bool line);
  /// The next sampling point, kNever while waiting for an edge of the line.
  Cycle next() const { return state_ == State::kReceiving ? sample_ : kNever; }

  const Character& character() const { return character_; }
  bool receiving() const { return state_ == State::kReceiving; }
  int bit() const { return bit_; }

 private:
  enum class State : std::uint8_t { kIdle, kReceiving, kBreak };
  void start(Cycle now);
  bool sample(bool line);

  State state_ = State::kIdle;
  bool line_ = true;
  int bit_ = kBitCycles[0];
  int index_ = 0;       // 0 start bit, 1..8 data, 9 parity, 10 stop
  unsigned shift_ = 0;  // data and parity, first bit lowest
  Cycle sample_ = kNever;
  Cycle idle_since_ = 0;
  Character character_;
};

}  // namespace profibus
