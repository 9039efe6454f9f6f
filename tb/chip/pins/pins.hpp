#pragma once
// The pins of a chip as known to the bench: numbered, with a name and a width. Their meaning is defined in the chip's
// room.
#include <cstdint>
#include <string>
#include <vector>

namespace dsdpv1::tb {

/// Index in the chip's PinTable.
using PinNumber = std::uint8_t;
/// Bit n: the pin with number n.
using PinMask = std::uint32_t;
/// 0 or 1 for a single wire, the value for several.
using Level = std::int16_t;
constexpr Level kLevelZ = -1;  ///< released
constexpr Level kLevelX = -2;  ///< unknown

/// A pin has this level from tick `at` on.
struct PinEdge {
  std::int64_t at = 0;
  PinNumber pin = 0;
  Level level = kLevelZ;
};

struct PinInfo {
  const char* name = nullptr;  ///< from the datasheet
  int width = 1;               ///< number of wires, 1..15
  bool input = false;
  const char* bus = nullptr;  ///< for two pins that are the directions of one bus: its name, shown in waves
  bool line = false;          ///< sends to the bus or receives it
  bool released = false;      ///< an output that may be kLevelZ
  const char* rulings = "";   ///< when an output changes, and to what: "H1, H3"
};

/// At most kMostPins.
using PinTable = std::vector<PinInfo>;
constexpr std::size_t kMostPins = 32;

/// Pins shown together in waveform viewers, by their names in waves.
struct PinGroup {
  const char* title;  ///< one word
  std::vector<const char*> pins;
};

constexpr PinMask mask_of(PinNumber pin) { return PinMask{1} << pin; }
/// A chip's pins that are `wanted`.
template <class Wanted>
PinMask pins_where(const PinTable& pins, const Wanted& wanted) {
  PinMask mask = 0;
  for (std::size_t pin = 0; pin < pins.size(); ++pin)
    if (wanted(pins[pin])) mask |= mask_of(static_cast<PinNumber>(pin));
  return mask;
}
/// All inputs of a chip.
inline PinMask inputs_of(const PinTable& pins) {
  return pins_where(
      pins, [](const PinInfo& pin) { return pin.input; });
}
/// Pins that are a direction of a bus.
inline PinMask data_of(const PinTable& pins) {
  return pins_where(
      pins, [](const PinInfo& pin) { return pin.bus != nullptr; });
}
/// All pins of a chip.
inline PinMask all_of(const PinTable& pins) {
  return pins.size() >= kMostPins ? ~PinMask{0} : (PinMask{1} << pins.size()) - 1;
}
inline PinMask outputs_of(const PinTable& pins) { return all_of(pins) & ~inputs_of(pins); }

/// "1", "7FF", "z", "x".
std::string level_text(const PinInfo& pin, Level level);

}  // namespace dsdpv1::tb
