#pragma once
// The pins of the mailbox, each one wire, and the way in which their changes leave and enter the chip.
#include <array>
#include <cstddef>
#include <cstdint>

#include "model/profibus/time.hpp"

namespace dsdpv1::mailbox {

using profibus::Cycle;
using profibus::Tick;

enum class Pin : std::uint8_t {
  // inputs
  kReset,  ///< low-active
  kXss,    ///< low-active: selects the SPI port
  kSck,
  kMosi,
  kPbrxd,
  // outputs
  kMiso,  ///< kLevelZ while not selected
  kInt,   ///< low-active: unread outputs
  kPbtxd,
  kPbrts,
};
constexpr int kPinCount = 9;

using Level = std::int16_t;
constexpr Level kLevelZ = -1;

inline const char* name(Pin pin) {
  constexpr std::array<const char*, kPinCount> kNames = {"RESET", "XSS", "SCK",   "MOSI", "PBRXD",
                                                         "MISO",  "INT", "PBTXD", "PBRTS"};
  return kNames[static_cast<std::size_t>(pin)];
}
constexpr std::uint32_t mask(Pin pin) { return std::uint32_t{1} << static_cast<unsigned>(pin); }
constexpr std::uint32_t kOutputPins = ((1U << kPinCount) - 1) & ~(mask(Pin::kMiso) - 1);

/// Receives the changes of output pins, in order of time. `call` is never null while attached.
struct PinSink {
  void (*call)(void* self, Tick at, Pin pin, Level level) = nullptr;
  void* self = nullptr;
};

}  // namespace dsdpv1::mailbox
