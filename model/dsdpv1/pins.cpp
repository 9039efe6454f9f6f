#include "model/dsdpv1/pins.hpp"

#include <array>

namespace dsdpv1 {

const char* name(Pin pin) {
  constexpr std::array<const char*, kRsuPinCount> kNames = {
      "RESET", "R_REQ", "R_STA", "CSR",   "RD",    "WR",  "A",    "D_IN",  "PBRXD", "L_REQ",
      "L_STA", "D_OUT", "INTR0", "PBTXD", "PBRTS", "PBF", "BR",   "READY", "XSS",   "SCK",
      "MOSI",  "RXD",   "MODE",  "ADR",   "UBR",   "UIV", "MISO", "TXD"};
  return kNames[static_cast<std::size_t>(pin)];
}

int width(Pin pin) {
  switch (pin) {
    case Pin::kA: return 11;
    case Pin::kDIn:
    case Pin::kDOut: return 8;
    case Pin::kUbr:
    case Pin::kUiv: return 3;
    case Pin::kMode:
    case Pin::kAdr: return 2;
    default: return 1;
  }
}

}  // namespace dsdpv1
