#include "kinds/dsdpv1/pins/pin_table.hpp"

#include <initializer_list>
#include <map>
#include <string_view>

namespace dsdpv1::tb {

static_assert(kLevelZ == dsdpv1::kLevelZ && kLevelX == dsdpv1::kLevelX);

namespace {

const char* rulings_of(dsdpv1::Pin pin) {
  switch (pin) {
    case dsdpv1::Pin::kLReq:
    case dsdpv1::Pin::kLSta: return "H1, H2, H3, H4, H8";
    case dsdpv1::Pin::kDOut: return "P5, P6, P12, D1, D3, D13";
    case dsdpv1::Pin::kIntr0: return "P7, H3";
    case dsdpv1::Pin::kPbtxd: return "S11, S13, S14, S20, S26";
    case dsdpv1::Pin::kPbrts: return "P2, S11";
    case dsdpv1::Pin::kPbf: return "P3, S15, S18";
    case dsdpv1::Pin::kBr: return "P3, S1, S9";
    case dsdpv1::Pin::kReady: return "P3, D7";
    case dsdpv1::Pin::kMiso: return "SP3, SP6, SP8, SP10";
    case dsdpv1::Pin::kTxd: return "UA2, UA4, UA10";
    default: return "";
  }
}

PinTable make_pins(int count) {
  PinTable table;
  for (int i = 0; i < count; ++i) {
    const auto pin = static_cast<dsdpv1::Pin>(i);
    const bool data = pin == dsdpv1::Pin::kDIn || pin == dsdpv1::Pin::kDOut;
    table.push_back({dsdpv1::name(pin), dsdpv1::width(pin), dsdpv1::is_input(pin), data ? "D" : nullptr,
                     pin == dsdpv1::Pin::kPbrxd || pin == dsdpv1::Pin::kPbtxd,
                     !dsdpv1::is_input(pin) && dsdpv1::kPinRows[i].level == dsdpv1::kLevelZ, rulings_of(pin)});
  }
  return table;
}

/// A signal of waves.
struct Shown {
  const char* group;
  int place;
  const char* name;
};

constexpr Shown kShown[] = {
#define DSDPV1_PIN(pin, name, width, direction, level, group, place, ...) {group, place, name},
#include "model/dsdpv1/pins.inc"
    {"host", 5, "D"},  // D_IN and D_OUT: for waves that show the two directions of D separately
    {"spi", 4, "spi_request"},
    {"spi", 6, "spi_reply"},
    {"uart", 2, "uart_request"},
    {"uart", 4, "uart_reply"}};

PinGroup group_of(const char* title) {
  std::map<int, const char*> by_place;
  for (const Shown& each : kShown)
    if (each.group == std::string_view(title)) by_place.emplace(each.place, each.name);
  PinGroup group{title, {}};
  for (const auto& [place, name] : by_place) group.pins.push_back(name);
  return group;
}

std::vector<PinGroup> groups_of(std::initializer_list<const char*> titles) {
  std::vector<PinGroup> groups;
  for (const char* title : titles) groups.push_back(group_of(title));
  return groups;
}

}  // namespace

const PinTable& pins_of(Part part) {
  static const PinTable plain = make_pins(kPinCount), rsu = make_pins(kRsuPinCount);
  return has_serial_ports(part) ? rsu : plain;
}

const std::vector<PinGroup>& pin_groups_of(Part part) {
  static const auto plain = groups_of({"handshake", "host", "line", "status"}),
                    rsu = groups_of({"handshake", "host", "line", "status", "spi", "uart", "straps"});
  return has_serial_ports(part) ? rsu : plain;
}

}  // namespace dsdpv1::tb
