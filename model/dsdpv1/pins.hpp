#pragma once
// The pins of table 1 and those that the DSDPV1-RSU has besides (R2), a row of pins.inc each, and how a change of one
// leaves or enters the core.
#include <cstdint>

#include "model/dsdpv1/part.hpp"
#include "model/profibus/time.hpp"

namespace dsdpv1 {

using profibus::Cycle;
using profibus::Tick;

enum class Pin : std::uint8_t {
#define DSDPV1_PIN(pin, ...) pin,
#include "model/dsdpv1/pins.inc"
};

/// 0 or 1 for a single pin, the value for A, D and the straps.
using Level = std::int16_t;
constexpr Level kLevelZ = -1;
constexpr Level kLevelX = -2;
constexpr Level kHighestLevel = 0x7FF;  ///< of A

enum class Direction : std::uint8_t { kInput, kOutput };

/// What pins.inc says of a pin.
struct PinRow {
  const char* name;
  int width;
  Direction direction;
  Level level;
  bool of_all_parts;
};

constexpr PinRow kPinRows[] = {
#define DSDPV1_PIN(pin, name, width, direction, level, ...) {name, width, Direction::direction, level, true},
#define DSDPV1_RSU_PIN(pin, name, width, direction, level, ...) {name, width, Direction::direction, level, false},
#include "model/dsdpv1/pins.inc"
};

constexpr int count_of_all_parts() {
  int count = 0;
  for (const PinRow& row : kPinRows) count += row.of_all_parts ? 1 : 0;
  return count;
}
constexpr int kPinCount = count_of_all_parts();  ///< of the DSDPV1 and -R: the first ones
constexpr int kRsuPinCount = static_cast<int>(sizeof kPinRows / sizeof(PinRow));  ///< of the DSDPV1-RSU: all
constexpr int pin_count(Part part) { return has_serial_ports(part) ? kRsuPinCount : kPinCount; }

/// Its place in tables of pins.
constexpr std::uint8_t number(Pin pin) { return static_cast<std::uint8_t>(pin); }
constexpr std::uint32_t mask(Pin pin) { return std::uint32_t{1} << static_cast<unsigned>(pin); }

/// Table 1's name of a pin ("L_REQ"); D_IN and D_OUT for the two directions of D.
constexpr const char* name(Pin pin) { return kPinRows[number(pin)].name; }
/// Number of wires: 11 for A, 8 for D, 2 for MODE and ADR, 3 for UBR and UIV, else 1.
constexpr int width(Pin pin) { return kPinRows[number(pin)].width; }
constexpr bool is_input(Pin pin) { return kPinRows[number(pin)].direction == Direction::kInput; }

constexpr std::uint32_t outputs_among(int pins) {
  std::uint32_t outputs = 0;
  for (int i = 0; i < pins; ++i) outputs |= is_input(static_cast<Pin>(i)) ? 0 : mask(static_cast<Pin>(i));
  return outputs;
}
/// Outputs of the DSDPV1 and the DSDPV1-R; of the DSDPV1-RSU.
constexpr std::uint32_t kOutputPins = outputs_among(kPinCount), kRsuOutputPins = outputs_among(kRsuPinCount);
constexpr std::uint32_t outputs_of(Part part) { return has_serial_ports(part) ? kRsuOutputPins : kOutputPins; }

/// Receives the changes of output pins, in order of time. `call` is never null while attached.
struct PinSink {
  void (*call)(void* self, Tick at, Pin pin, Level level) = nullptr;
  void* self = nullptr;
};

}  // namespace dsdpv1
