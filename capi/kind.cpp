#include "capi/kind.hpp"

#include <algorithm>

#include "capi/error.hpp"

namespace dsdpv1::capi {
namespace {

std::vector<tb::Level> reset_levels_of(const tb::ChipKind& chip) {
  const std::unique_ptr<tb::OwnSettings> settings = chip.make_chip_settings();
  const std::unique_ptr<tb::PinDevice> device = chip.make_device({chip.name(), *settings});
  std::vector<tb::Level> levels;
  for (std::size_t pin = 0; pin < chip.pins().size(); ++pin)
    levels.push_back(device->level(static_cast<tb::PinNumber>(pin)));
  return levels;
}

/// Two pins are the directions of one bus.
bool has_data_bus(const tb::ChipKind& chip) {
  return std::any_of(
      chip.pins().begin(), chip.pins().end(), [](const tb::PinInfo& pin) { return pin.bus != nullptr; });
}

}  // namespace

Kind::Kind(const tb::ChipKind& its_chip)
    : chip(its_chip),
      reset_levels(reset_levels_of(chip)),
      parameters(parameters_of(chip)),
      has_host_bus(has_data_bus(chip)) {}

void refuse_host_bus() { fail(DPSIM_ERR_UNSUPPORTED, "a chip of this kind has no parallel host bus"); }

const std::deque<Kind>& kinds() {
  static const std::deque<Kind> all = [] {
    std::deque<Kind> list;
    for (const tb::ChipKind* each : tb::chip_kinds()) list.emplace_back(*each);
    return list;
  }();
  return all;
}

const Kind* find_kind(const char* name) {
  if (name == nullptr || *name == '\0') return &kinds().front();
  for (const Kind& kind : kinds())
    if (name == std::string(kind.chip.name())) return &kind;
  return nullptr;
}

const Kind& kind_of(const char* name) {
  if (const Kind* kind = find_kind(name)) return *kind;
  std::string allowed;
  for (const Kind& kind : kinds()) allowed += (allowed.empty() ? "" : ", ") + std::string(kind.chip.name());
  fail(DPSIM_ERR_NOT_FOUND, "kind is \"" + std::string(name) + "\", expected " + allowed);
}

}  // namespace dsdpv1::capi
