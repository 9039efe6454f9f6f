#pragma once
// The last cycles of a lockstep run: what changed at the inputs, at the model's outputs and at the RTL's; and as a
// wave.
#include <array>
#include <deque>
#include <string>
#include <vector>

#include "model/dsdpv1/pins.hpp"

namespace cosim {

using dsdpv1::Level;
using dsdpv1::Pin;
using dsdpv1::Tick;

enum class Side : std::uint8_t { kInput, kModel, kRtl };
constexpr std::size_t kSides = 3;

/// What a station of the segment sent last, as far as it can be read from the edges of the line.
struct LineTelegram {
  Tick start = 0;
  std::string text;  ///< in words; empty when there was none
};

class History {
 public:
  explicit History(int cycles) : span_(cycles * profibus::kTicksPerCycle) {}

  void begin(Side side, Pin pin, Level level) { levels_.at(static_cast<std::size_t>(side)).at(index(pin)) = level; }
  void add(Tick at, Side side, Pin pin, Level level);
  /// Writes what happened in the last cycles up to `end` to `path` (.vcd, .fst): scopes inputs, model, rtl, one below
  /// the other. Throws tb::InputError.
  void write_wave(const std::string& path, Tick end) const;
  /// The last telegram on PBRXD; `rate` 0..9 is that of the chip, anything else: as the shortest pulse says.
  LineTelegram last_telegram(int rate) const;

 private:
  struct Change {
    Tick at;
    Side side;
    Pin pin;
    Level level;
  };
  struct LineEdge {
    Tick at;
    bool level;
  };
  static std::size_t index(Pin pin) { return static_cast<std::size_t>(pin); }
  void forget_before(Tick oldest);
  int likely_rate() const;

  Tick span_;
  std::array<std::array<Level, dsdpv1::kPinCount>, kSides> levels_{};  ///< before the first change kept
  std::deque<Change> changes_;
  std::deque<LineEdge> line_;
};

}  // namespace cosim
