#pragma once
// The pins that the core has: reset, the line, the interrupt and the sign of the data exchange. The CPU's bus is the
// register call of Chip.
#include <cstdint>

#include "model/profibus/time.hpp"

namespace dsdpv1::spc3 {

using profibus::Cycle;
using profibus::Tick;

enum class Pin : std::uint8_t { kReset, kRxd, kXCts, kTxd, kRts, kXInt, kXDataExch };
constexpr int kPinCount = 7;

/// 0 or 1.
using Level = std::int16_t;

constexpr std::uint32_t mask(Pin pin) { return std::uint32_t{1} << static_cast<unsigned>(pin); }
constexpr std::uint32_t kOutputPins = mask(Pin::kTxd) | mask(Pin::kRts) | mask(Pin::kXInt) | mask(Pin::kXDataExch);

/// The manual's name of a pin (M table 2.1).
constexpr const char* name(Pin pin) {
  constexpr const char* kNames[kPinCount] = {"RESET", "RXD", "XCTS", "TXD", "RTS", "X/INT", "XDATAEXCH"};
  return kNames[static_cast<unsigned>(pin)];
}

/// Receives the changes of output pins, in order of time. `call` is never null while attached.
struct PinSink {
  void (*call)(void* self, Tick at, Pin pin, Level level) = nullptr;
  void* self = nullptr;
};

}  // namespace dsdpv1::spc3
