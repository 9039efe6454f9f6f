#include "kinds/dsdpv1/pins/pin_table.hpp"

namespace dsdpv1::tb {

static_assert(kLevelZ == dsdpv1::kLevelZ && kLevelX == dsdpv1::kLevelX);

namespace {

PinTable make_pins(Part part) {
  PinTable table;
  for (int i = 0; i < pin_count(part); ++i) {
    const auto pin = static_cast<dsdpv1::Pin>(i);
    const bool data = pin == dsdpv1::Pin::kDIn || pin == dsdpv1::Pin::kDOut;
    table.push_back({dsdpv1::name(pin), dsdpv1::width(pin), dsdpv1::is_input(pin), data ? "D" : nullptr,
                     pin == dsdpv1::Pin::kPbrxd || pin == dsdpv1::Pin::kPbtxd,
                     pin == dsdpv1::Pin::kDOut || pin == dsdpv1::Pin::kMiso});
  }
  return table;
}

std::vector<PinGroup> groups_with(std::vector<PinGroup> more) {
  // D_IN and D_OUT: of waves that show the two directions of D by themselves
  std::vector<PinGroup> groups = {{"handshake", {"R_REQ", "L_REQ", "R_STA", "L_STA", "INTR0"}},
                                  {"host", {"CSR", "RD", "WR", "A", "D", "D_IN", "D_OUT"}},
                                  {"line", {"PBRXD", "PBTXD", "PBRTS"}},
                                  {"status", {"RESET", "READY", "BR", "PBF"}}};
  groups.insert(groups.end(), more.begin(), more.end());
  return groups;
}

}  // namespace

const PinTable& pins_of(Part part) {
  static const PinTable plain = make_pins(Part::kDsdpv1), rsu = make_pins(Part::kRsu);
  return part == Part::kRsu ? rsu : plain;
}

const std::vector<PinGroup>& pin_groups_of(Part part) {
  static const std::vector<PinGroup> plain = groups_with({});
  static const std::vector<PinGroup> rsu =
      groups_with({{"spi", {"XSS", "SCK", "MOSI", "spi_request", "MISO", "spi_reply"}},
                   {"uart", {"RXD", "uart_request", "TXD", "uart_reply"}},
                   {"straps", {"MODE", "ADR", "UBR", "UIV"}}});
  return part == Part::kRsu ? rsu : plain;
}

}  // namespace dsdpv1::tb
