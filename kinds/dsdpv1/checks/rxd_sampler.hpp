#pragma once
// Characters on RXD as the chip samples them: start bit, 8 data bits, parity, stop bit (UA1), each in its middle and
// just before an edge of CLK (UA2, P9).
#include <cstdint>
#include <optional>

#include "kinds/dsdpv1/checks/serial_settings.hpp"

namespace dsdpv1::checks {

constexpr int kBitsPerCharacter = 11;

/// The first edge of CLK that sees a change at `at`.
constexpr Tick edge_seeing(Tick at) { return at / kTicksPerCycle + 1; }

struct RxdCharacter {
  Tick fell = 0;        ///< begin of its start bit, a tick
  Tick idle_since = 0;  ///< edge of CLK from which the silence before the character counts
  Tick stop = 0;        ///< tick of the stop bit's sample: changes at it come later
  std::uint8_t value = 0;
  bool parity_ok = false, stop_ok = false;
  bool low = false;  ///< all its bits up to the stop bit are 0
};

class RxdSampler {
 public:
  /// Restarts with the present level: low is a break. Silence counts from edge `idle_since`. `bit`: cycles.
  void restart(bool level, Tick idle_since, Tick bit);
  /// As restart(), with a line that was high and fell at `fell`.
  void restart_with_start_bit(Tick fell, Tick bit);
  /// Advances time to `at`, which is not before a reported change; changes at `at` are reported after it. Returns the
  /// character that is complete by then.
  std::optional<RxdCharacter> advance(Tick at);
  /// RXD changes, after advance() to the same tick. An edge of CLK sees the level before the next change.
  void change(Tick at, bool level);

  /// A start bit has begun.
  bool receiving() const { return state_ == State::kReceiving; }
  /// Edge of CLK from which the present silence counts; none in a break or a character.
  std::optional<Tick> idle_since() const { return state_ == State::kIdle ? std::optional(idle_since_) : std::nullopt; }

 private:
  enum class State : std::uint8_t { kIdle, kReceiving, kBreak };
  Tick sample_tick() const;
  bool take(bool level);

  State state_ = State::kIdle;
  bool level_ = true;
  Tick bit_ = 0, idle_since_ = 0;
  Tick edge_ = 0;       ///< edge that sees the start bit
  int index_ = 0;       ///< of the next sample: 0 start bit, 1..8 data, 9 parity, 10 stop bit
  unsigned shift_ = 0;  ///< data and parity, first bit lowest
  RxdCharacter character_;
};

}  // namespace dsdpv1::checks
