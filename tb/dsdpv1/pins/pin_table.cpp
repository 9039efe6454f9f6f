#include "tb/dsdpv1/pins/pin_table.hpp"

namespace dsdpv1::tb {

static_assert(kLevelZ == dsdpv1::kLevelZ && kLevelX == dsdpv1::kLevelX);

const PinTable& dsdpv1_pins() {
  static const PinTable pins = [] {
    PinTable table;
    for (int i = 0; i < dsdpv1::kPinCount; ++i) {
      const auto pin = static_cast<dsdpv1::Pin>(i);
      const bool data = pin == dsdpv1::Pin::kDIn || pin == dsdpv1::Pin::kDOut;
      table.push_back({dsdpv1::name(pin), dsdpv1::width(pin), dsdpv1::is_input(pin), data ? "D" : nullptr});
    }
    return table;
  }();
  return pins;
}

const std::vector<PinGroup>& dsdpv1_pin_groups() {
  // D_IN and D_OUT: of waves that show the two directions of D by themselves
  static const std::vector<PinGroup> groups = {{"handshake", {"R_REQ", "L_REQ", "R_STA", "L_STA", "INTR0"}},
                                               {"host", {"CSR", "RD", "WR", "A", "D", "D_IN", "D_OUT"}},
                                               {"line", {"PBRXD", "PBTXD", "PBRTS"}},
                                               {"status", {"RESET", "READY", "BR", "PBF"}}};
  return groups;
}

}  // namespace dsdpv1::tb
