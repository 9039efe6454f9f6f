#include "model/dsdpv1/pins.hpp"

#include <array>

namespace dsdpv1 {

const char* name(Pin pin) {
  constexpr std::array<const char*, kPinCount> kNames = {"RESET", "R_REQ", "R_STA", "CSR",   "RD",    "WR",
                                                         "A",     "D_IN",  "PBRXD", "L_REQ", "L_STA", "D_OUT",
                                                         "INTR0", "PBTXD", "PBRTS", "PBF",   "BR",    "READY"};
  return kNames[static_cast<std::size_t>(pin)];
}

int width(Pin pin) {
  if (pin == Pin::kA) return 11;
  return pin == Pin::kDIn || pin == Pin::kDOut ? 8 : 1;
}

}  // namespace dsdpv1
