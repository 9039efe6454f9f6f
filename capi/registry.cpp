// Kinds, pins, parameters and reasons by number.
#include "capi/error.hpp"
#include "capi/kind.hpp"
#include "capi/names.hpp"
#include "capi/sized.hpp"

using capi::fail;
using capi::guarded;
using capi::kind_of;

namespace {

void need_number(const char* what, std::size_t number, std::size_t count) {
  if (number >= count)
    fail(DPSIM_ERR_NOT_FOUND,
         std::string(what) + " is " + std::to_string(number) + ", expected 0 to " + std::to_string(count - 1));
}

const tb::PinTable& pins_of(const char* kind) { return kind_of(kind).chip.pins(); }
const std::vector<capi::Parameter>& parameters_of(const char* kind) { return kind_of(kind).parameters; }

template <class Count>
std::size_t count_of(const char* kind, const Count& count) noexcept {
  const capi::Kind* found = capi::find_kind(kind);
  return found == nullptr ? 0 : count(*found);
}

dpsim_pin_info pin_info(const capi::Kind& kind, std::size_t number) {
  const tb::PinInfo& pin = kind.chip.pins()[number];
  dpsim_pin_info info{};
  info.number = static_cast<std::uint16_t>(number);
  info.width = static_cast<std::uint8_t>(pin.width);
  info.input = pin.input ? 1 : 0;
  info.name = pin.name;
  info.bus = pin.bus;
  info.reset_level = kind.reset_levels[number];
  return info;
}

dpsim_parameter_info parameter_info(const capi::Parameter& parameter) {
  dpsim_parameter_info info{};
  info.name = parameter.name.c_str();
  info.unit = parameter.field->type.kind == tb::keys::Kind::kTime ? "ticks" : parameter.field->type.unit.c_str();
  info.description = parameter.field->doc.c_str();
  info.minimum = parameter.range.min;
  info.maximum = parameter.range.max;
  info.default_value = parameter.default_value;
  return info;
}

}  // namespace

size_t dpsim_kind_count() { return capi::kinds().size(); }
const char* dpsim_kind_name(size_t index) {
  return index < capi::kinds().size() ? capi::kinds()[index].chip.name() : nullptr;
}

size_t dpsim_pin_count(const char* kind) {
  return count_of(
      kind, [](const capi::Kind& each) { return each.chip.pins().size(); });
}

dpsim_status dpsim_pin_get(const char* kind, size_t number, dpsim_pin_info* info) {
  return guarded(
      __func__,
      [&] {
        need_number("number", number, pins_of(kind).size());
        capi::give(pin_info(kind_of(kind), number), info, "info");
      });
}

dpsim_status dpsim_pin_find(const char* kind, const char* name, uint16_t* number) {
  return guarded(
      __func__,
      [&] {
        capi::need(name, "name");
        capi::need(number, "number");
        const tb::PinTable& pins = pins_of(kind);
        for (std::size_t i = 0; i < pins.size(); ++i) {
          if (std::string(pins[i].name) != name) continue;
          *number = static_cast<std::uint16_t>(i);
          return;
        }
        fail(DPSIM_ERR_NOT_FOUND, "the chip has no pin \"" + std::string(name) + "\"");
      });
}

size_t dpsim_parameter_count(const char* kind) {
  return count_of(
      kind, [](const capi::Kind& each) { return each.parameters.size(); });
}

dpsim_status dpsim_parameter_get(const char* kind, size_t index, dpsim_parameter_info* info) {
  return guarded(
      __func__,
      [&] {
        need_number("index", index, parameters_of(kind).size());
        capi::give(parameter_info(parameters_of(kind)[index]), info, "info");
      });
}

size_t dpsim_reason_count(const char* kind) {
  return count_of(
      kind, [](const capi::Kind& each) { return each.chip.reasons().size(); });
}

dpsim_status dpsim_reason_get(const char* kind, size_t reason, dpsim_reason_info* info) {
  return guarded(
      __func__,
      [&] {
        const auto& reasons = kind_of(kind).chip.reasons();
        need_number("reason", reason, reasons.size());
        dpsim_reason_info filled{};
        filled.severity = static_cast<dpsim_severity>(profibus::severity(reasons[reason]));
        filled.code = profibus::code(reasons[reason]);
        capi::give(filled, info, "info");
      });
}
