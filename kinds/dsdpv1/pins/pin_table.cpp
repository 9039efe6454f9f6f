#include "kinds/dsdpv1/pins/pin_table.hpp"

#include <initializer_list>
#include <map>
#include <string_view>

namespace dsdpv1::tb {

static_assert(kLevelZ == dsdpv1::kLevelZ && kLevelX == dsdpv1::kLevelX);

namespace {

PinTable make_pins(int count) {
  PinTable table;
  for (int i = 0; i < count; ++i) {
    const auto pin = static_cast<dsdpv1::Pin>(i);
    const bool data = pin == dsdpv1::Pin::kDIn || pin == dsdpv1::Pin::kDOut;
    table.push_back({dsdpv1::name(pin), dsdpv1::width(pin), dsdpv1::is_input(pin), data ? "D" : nullptr,
                     pin == dsdpv1::Pin::kPbrxd || pin == dsdpv1::Pin::kPbtxd,
                     !dsdpv1::is_input(pin) && dsdpv1::kPinRows[i].level == dsdpv1::kLevelZ});
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
