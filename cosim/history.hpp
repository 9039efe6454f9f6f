#pragma once
// The last cycles of a lockstep run: what changed at the inputs, at the model's outputs and at the RTL's; and as a
// wave.
#include <array>
#include <deque>
#include <string>
#include <vector>

#include "cosim/line_history.hpp"
#include "model/dsdpv1/pins.hpp"

namespace dsdpv1::cosim {

enum class Side : std::uint8_t { kInput, kModel, kRtl };
constexpr std::size_t kSides = 3;
/// "inputs", "model", "rtl".
const char* name(Side side);

class History {
 public:
  /// Of the first so many pins.
  History(int cycles, int pins) : span_(cycles * profibus::kTicksPerCycle), pins_(static_cast<std::size_t>(pins)) {}

  void begin(Side side, Pin pin, Level level) { levels_.at(static_cast<std::size_t>(side)).at(index(pin)) = level; }
  void add(Tick at, Side side, Pin pin, Level level);
  /// Writes what happened in the last cycles up to `end` to `path` (.vcd, .fst): scopes inputs, model, rtl, one below
  /// the other. Throws tb::InputError.
  void write_wave(const std::string& path, Tick end) const;
  /// The last telegram on PBRXD; see LineHistory.
  LineTelegram last_telegram(int rate) const { return line_.last_telegram(rate); }

 private:
  struct Change {
    Tick at;
    Side side;
    Pin pin;
    Level level;
  };
  static std::size_t index(Pin pin) { return static_cast<std::size_t>(pin); }
  void forget_before(Tick oldest);

  Tick span_;
  std::size_t pins_;
  std::array<std::array<Level, dsdpv1::kRsuPinCount>, kSides> levels_{};  ///< before the first change kept
  std::deque<Change> changes_;
  LineHistory line_;
};

}  // namespace dsdpv1::cosim
