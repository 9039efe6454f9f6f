#pragma once
// The pins of M table 2.1, a row of pins.inc each, and how pin changes leave and enter the core.
#include <cstdint>

#include "model/profibus/time.hpp"

namespace dsdpv1::spc3 {

using profibus::Cycle;
using profibus::Tick;

enum class Pin : std::uint8_t {
#define SPC3_PIN(pin, ...) pin,
#include "model/spc3/pins.inc"
};

/// 0 or 1 for a single wire, the value for AB and DB.
using Level = std::int16_t;
constexpr Level kLevelZ = -1;           ///< released
constexpr Level kLevelX = -2;           ///< unknown
constexpr Level kHighestLevel = 0x7FF;  ///< of AB

enum class Direction : std::uint8_t { kInput, kOutput };

/// A row of pins.inc.
struct PinRow {
  const char* name;
  int width;
  Direction direction;
  Level level;
};

constexpr PinRow kPinRows[] = {
#define SPC3_PIN(pin, name, width, direction, ...) {name, width, Direction::direction, __VA_ARGS__},
#include "model/spc3/pins.inc"
};
constexpr int kPinCount = sizeof kPinRows / sizeof(PinRow);  ///< of the VPC3+: all

/// Index in tables of pins.
constexpr std::uint8_t number(Pin pin) { return static_cast<std::uint8_t>(pin); }
/// Pins of the chips without AB11 and SPI.
constexpr int kTablePinCount = number(Pin::kAb11);
constexpr const PinRow& row(Pin pin) { return kPinRows[number(pin)]; }
constexpr std::uint32_t mask(Pin pin) { return std::uint32_t{1} << static_cast<unsigned>(pin); }
constexpr bool is_input(Pin pin) { return row(pin).direction == Direction::kInput; }
/// As HDL can have it: "X_INT" for X/INT.
constexpr const char* name(Pin pin) { return row(pin).name; }
/// Number of wires: 11 for AB, 8 for DB, else 1.
constexpr int width(Pin pin) { return row(pin).width; }

constexpr std::uint32_t output_pins() {
  std::uint32_t pins = 0;
  for (int i = 0; i < kPinCount; ++i) pins |= is_input(static_cast<Pin>(i)) ? 0 : mask(static_cast<Pin>(i));
  return pins;
}
constexpr std::uint32_t kOutputPins = output_pins();

/// Receives the changes of output pins, in order of time. `call` is never null while attached.
struct PinSink {
  void (*call)(void* self, Tick at, Pin pin, Level level) = nullptr;
  void* self = nullptr;
};

}  // namespace dsdpv1::spc3
