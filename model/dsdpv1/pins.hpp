#pragma once
// The pins of table 1, and how a change of one leaves or enters the core.
#include <cstdint>

#include "model/profibus/time.hpp"

namespace dsdpv1 {

using profibus::Cycle;
using profibus::Tick;

enum class Pin : std::uint8_t {
  // inputs
  kReset,  ///< low-active
  kRReq,
  kRSta,
  kCsr,  ///< low-active
  kRd,   ///< low-active
  kWr,   ///< low-active
  kA,    ///< A[10:0], 0..0x7FF
  kDIn,  ///< D[7:0] as the user drives it, 0..0xFF or kLevelZ
  kPbrxd,
  // outputs
  kLReq,
  kLSta,
  kDOut,  ///< D[7:0] as the chip drives it, 0..0xFF, kLevelZ (released) or kLevelX (unknown)
  kIntr0,
  kPbtxd,
  kPbrts,
  kPbf,
  kBr,
  kReady,
};
constexpr int kPinCount = 18;

/// 0 or 1 for a single pin, the value for A and D.
using Level = std::int16_t;
constexpr Level kLevelZ = -1;
constexpr Level kLevelX = -2;

/// Table 1's name of a pin ("L_REQ"); D_IN and D_OUT for the two directions of D.
const char* name(Pin pin);
/// Number of wires: 11 for A, 8 for D, else 1.
int width(Pin pin);
constexpr bool is_input(Pin pin) { return pin <= Pin::kPbrxd; }
constexpr std::uint32_t mask(Pin pin) { return std::uint32_t{1} << static_cast<unsigned>(pin); }
constexpr std::uint32_t kOutputPins = ((1U << kPinCount) - 1) & ~(mask(Pin::kLReq) - 1);

/// Receives the changes of output pins, in order of time. `call` is never null while attached.
struct PinSink {
  void (*call)(void* self, Tick at, Pin pin, Level level) = nullptr;
  void* self = nullptr;
};

}  // namespace dsdpv1
