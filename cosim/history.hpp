#pragma once
// The last cycles of a lockstep run: changes of the inputs, of the model's outputs and of the RTL's, also as a wave.
#include <array>
#include <deque>
#include <string>
#include <vector>

#include "cosim/line_history.hpp"
#include "cosim/rtl.hpp"

namespace dsdpv1::cosim {

enum class Side : std::uint8_t { kInput, kModel, kRtl };
constexpr std::size_t kSides = 3;
/// "inputs", "model", "rtl".
const char* name(Side side);

class History {
 public:
  History(int cycles, const tb::ChipKind& kind)
      : span_(cycles * bus::kTicksPerCycle), pins_(kind.pins()), line_pin_(kind.board_pins().rxd) {}

  void begin(Side side, PinNumber pin, Level level) { levels_.at(static_cast<std::size_t>(side)).at(pin) = level; }
  void add(Tick at, Side side, PinNumber pin, Level level);
  /// Writes the changes of the last cycles up to `end` to `path` (.vcd, .fst): scopes inputs, model, rtl. Throws
  /// tb::InputError.
  void write_wave(const std::string& path, Tick end) const;
  /// The last telegram that the chip received; see LineHistory.
  LineTelegram last_telegram(int rate) const { return line_.last_telegram(rate); }

 private:
  struct Change {
    Tick at;
    Side side;
    PinNumber pin;
    Level level;
  };
  void forget_before(Tick oldest);

  Tick span_;
  const tb::PinTable& pins_;
  const PinNumber line_pin_;
  std::array<std::array<Level, kMostPins>, kSides> levels_{};  ///< before the first change kept
  std::deque<Change> changes_;
  LineHistory line_;
};

}  // namespace dsdpv1::cosim
