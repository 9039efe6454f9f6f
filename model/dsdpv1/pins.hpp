#pragma once
// The pins of table 1 and those that the DSDPV1-RSU has besides (R2), and how a change of one leaves or enters the
// core.
#include <cstdint>

#include "model/profibus/time.hpp"

namespace dsdpv1 {

using profibus::Cycle;
using profibus::Tick;

/// Which chip it is. DSDPV1-R is the DSDPV1 under another name; DSDPV1-RSU has SPI and UART beside the parallel port.
enum class Part : std::uint8_t { kDsdpv1, kR, kRsu };

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
  // inputs of the DSDPV1-RSU
  kXss,  ///< low-active
  kSck,
  kMosi,
  kRxd,
  kMode,  ///< MODE[1:0]: 0 parallel, 1 SPI, 2 UART, 3 as 0
  kAdr,   ///< ADR[1:0]: the card's own address, 1 or 2
  kUbr,   ///< UBR[2:0]: baud rate of the UART (UA1)
  kUiv,   ///< UIV[2:0]: interval between its characters (UA3)
  // outputs of the DSDPV1-RSU
  kMiso,  ///< kLevelZ when released
  kTxd,
};
constexpr int kPinCount = 18;     ///< of the DSDPV1 and the DSDPV1-R: the first ones
constexpr int kRsuPinCount = 28;  ///< of the DSDPV1-RSU: all
constexpr int pin_count(Part part) { return part == Part::kRsu ? kRsuPinCount : kPinCount; }

/// 0 or 1 for a single pin, the value for A, D and the straps.
using Level = std::int16_t;
constexpr Level kLevelZ = -1;
constexpr Level kLevelX = -2;
constexpr Level kHighestLevel = 0x7FF;  ///< of A

/// Table 1's name of a pin ("L_REQ"); D_IN and D_OUT for the two directions of D.
const char* name(Pin pin);
/// Number of wires: 11 for A, 8 for D, 2 for MODE and ADR, 3 for UBR and UIV, else 1.
int width(Pin pin);
constexpr bool is_input(Pin pin) { return pin <= Pin::kPbrxd || (pin >= Pin::kXss && pin <= Pin::kUiv); }
/// Its place in tables of pins.
constexpr std::uint8_t number(Pin pin) { return static_cast<std::uint8_t>(pin); }
constexpr std::uint32_t mask(Pin pin) { return std::uint32_t{1} << static_cast<unsigned>(pin); }
/// Outputs of the DSDPV1 and the DSDPV1-R.
constexpr std::uint32_t kOutputPins = ((1U << kPinCount) - 1) & ~(mask(Pin::kLReq) - 1);
constexpr std::uint32_t outputs_of(Part part) {
  return part == Part::kRsu ? kOutputPins | mask(Pin::kMiso) | mask(Pin::kTxd) : kOutputPins;
}

/// Receives the changes of output pins, in order of time. `call` is never null while attached.
struct PinSink {
  void (*call)(void* self, Tick at, Pin pin, Level level) = nullptr;
  void* self = nullptr;
};

}  // namespace dsdpv1
