#pragma once
// The pins of table 1 and the additional ones of the DSDPV1-RSU (R2), a row of pins.inc each, and how pin changes leave
// and enter the core.
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

/// A row of pins.inc.
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

constexpr int kRsuPinCount = sizeof kPinRows / sizeof(PinRow);  ///< of the DSDPV1-RSU: all

/// Index in tables of pins.
constexpr std::uint8_t number(Pin pin) { return static_cast<std::uint8_t>(pin); }
constexpr std::uint32_t mask(Pin pin) { return std::uint32_t{1} << static_cast<unsigned>(pin); }
/// Mask of the pins whose rows are `wanted`.
template <class Wanted>
constexpr std::uint32_t pins_where(const Wanted& wanted) {
  std::uint32_t pins = 0;
  for (int i = 0; i < kRsuPinCount; ++i) pins |= wanted(kPinRows[i]) ? mask(static_cast<Pin>(i)) : 0;
  return pins;
}

/// The pins of all parts; those of the DSDPV1-RSU only.
constexpr std::uint32_t kCommonPins = pins_where([](const PinRow& row) { return row.of_all_parts; });
constexpr std::uint32_t kSerialPins = pins_where([](const PinRow& row) { return !row.of_all_parts; });
constexpr int kPinCount = __builtin_popcount(kCommonPins);  ///< of the DSDPV1 and the DSDPV1-R: the first ones
constexpr int pin_count(Part part) { return has_serial_ports(part) ? kRsuPinCount : kPinCount; }

/// Table 1's name of a pin ("L_REQ"); D_IN and D_OUT for the two directions of D.
constexpr const char* name(Pin pin) { return kPinRows[number(pin)].name; }
/// Number of wires: 11 for A, 8 for D, 2 for MODE and ADR, 3 for UBR and UIV, else 1.
constexpr int width(Pin pin) { return kPinRows[number(pin)].width; }
constexpr bool is_input(Pin pin) { return kPinRows[number(pin)].direction == Direction::kInput; }
/// Outputs of the DSDPV1-RSU; of the DSDPV1 and the DSDPV1-R.
constexpr std::uint32_t kRsuOutputPins =
    pins_where([](const PinRow& row) { return row.direction == Direction::kOutput; });
constexpr std::uint32_t kOutputPins = kRsuOutputPins & kCommonPins;
constexpr std::uint32_t outputs_of(Part part) { return has_serial_ports(part) ? kRsuOutputPins : kOutputPins; }

/// Receives the changes of output pins, in order of time. `call` is never null while attached.
struct PinSink {
  void (*call)(void* self, Tick at, Pin pin, Level level) = nullptr;
  void* self = nullptr;
};

}  // namespace dsdpv1
